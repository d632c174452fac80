#include "services/transport/plug_ins.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "services/transport/announcement.hpp"

namespace roci::services::transport {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "libroci_transport_";
constexpr std::string_view kSuffix = ".so";

// ROCI_PLUGIN_PATH (folders separated by colons) comes before the folder that belongs to the running program.
std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  if (const char* given = std::getenv("ROCI_PLUGIN_PATH")) {
    const std::string_view list(given);
    for (std::size_t begin = 0; begin <= list.size();) {
      const auto end = std::min(list.find(':', begin), list.size());
      if (end > begin) folders.emplace_back(list.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  std::error_code error;
  const auto program = fs::read_symlink("/proc/self/exe", error);
  if (!error) folders.push_back(program.parent_path().parent_path() / "lib" / "rocinante");
  return folders;
}

std::string join(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "none" : text;
}

[[noreturn]] void refuse_unknown(std::string_view vendor) {
  std::string text =
      "unknown DDS transport \"" + std::string(vendor) + "\"; installed: " + join(installed_transports()) +
      ". Choose one of them with --dds, ROCI_DDS or the `vendor` of the service in mission.yaml (looked in";
  for (const auto& folder : plugin_folders()) text += " " + folder.string();
  throw TransportError(text + ")");
}

fs::path find_plugin(std::string_view vendor) {
  const auto name = std::string(kPrefix) + std::string(vendor) + std::string(kSuffix);
  if (name.find('/') != std::string::npos) refuse_unknown(vendor);
  for (const auto& folder : plugin_folders()) {
    std::error_code error;
    if (auto path = folder / name; fs::is_regular_file(path, error)) return path;
  }
  refuse_unknown(vendor);
}

// Plug-ins stay loaded until the process ends: their threads and statics outlive every Transport.
CreateTransport* load(const fs::path& plugin) {
  void* library = dlopen(plugin.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  void* symbol = library ? dlsym(library, kCreateTransportSymbol) : nullptr;
  if (symbol) return reinterpret_cast<CreateTransport*>(symbol);
  const char* why = dlerror();
  throw TransportError("cannot load " + plugin.string() + ": " + (why ? why : "unknown error") +
                       ". Install the vendor's library or choose another transport with --dds");
}

}  // namespace

std::string plugin_path() {
  std::string text;
  for (const auto& folder : plugin_folders()) text += (text.empty() ? "" : ":") + folder.string();
  return text;
}

std::vector<std::string> installed_transports() {
  std::vector<std::string> names;
  for (const auto& folder : plugin_folders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const auto file = entry.path().filename().string();
      if (file.size() > kPrefix.size() + kSuffix.size() && file.starts_with(kPrefix) &&
          file.ends_with(kSuffix)) {
        names.push_back(file.substr(kPrefix.size(), file.size() - kPrefix.size() - kSuffix.size()));
      }
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::unique_ptr<Transport> open_transport(std::string_view vendor, const TransportOptions& options) {
  TransportOptions announced = options;
  if (!announced.announcement) announced.announcement = own_announcement();
  return load(find_plugin(vendor))(announced);
}

}  // namespace roci::services::transport
