#include "services/launch/continuation.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "core/durable/durable_file.hpp"
#include "services/launch/options.hpp"

namespace roci::services::launch {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view kResume = "--resume";
constexpr char kLockFile[] = "launch.lock";

std::string comma_separated(const std::vector<std::string>& parts) {
  std::string text;
  for (const auto& part : parts) text += (text.empty() ? "" : ",") + part;
  return text;
}

// Removes "--resume FOLDER" (or "--resume=FOLDER"); empty if it does not stand there.
std::string take_resumed_folder(std::vector<std::string>& arguments) {
  for (auto at = arguments.begin(); at != arguments.end(); ++at) {
    if (at->starts_with(std::string(kResume) + "=")) {
      std::string folder = at->substr(kResume.size() + 1);
      arguments.erase(at);
      return folder;
    }
    if (*at != kResume) continue;
    if (at + 1 == arguments.end() || (at + 1)->starts_with("--"))
      throw std::invalid_argument("--resume: name the folder of the run behind it: --resume RUN_FOLDER");
    std::string folder = *(at + 1);
    arguments.erase(at, at + 2);
    return folder;
  }
  return "";
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw std::invalid_argument("--resume " + folder.string() + ": " + why);
}

[[noreturn]] void refuse_damaged(const fs::path& folder) {
  refuse(folder, std::string(kContinuationFile) + " is damaged; start a new run");
}

json read_file(const fs::path& folder) {
  const fs::path file = folder / kContinuationFile;
  std::ifstream in(file);
  if (!in) refuse(folder, "there is no " + std::string(kContinuationFile) + " of a run in it");
  const json kept = json::parse(in, nullptr, false);
  if (!kept.is_object()) refuse_damaged(folder);
  const auto format = kept.find("format");
  if (format == kept.end() || !format->is_number_integer()) refuse_damaged(folder);
  if (*format > kContinuationFormat) refuse(folder, "a newer version began the run; go on with that one");
  return kept;
}

// What was resolved then is said again, so that neither environment nor working folder make a difference.
std::vector<std::string> command_line_of(const Options& options) {
  std::vector<std::string> out{options.mission.string(),
                               "--scenario",
                               options.scenario,
                               "--seed",
                               std::to_string(options.seed),
                               "--clock",
                               options.live ? "live" : "simulated",
                               "--dds",
                               options.connection.dds,
                               "--run",
                               options.run,
                               "--services",
                               comma_separated(options.services),
                               "--roster",
                               comma_separated(options.roster),
                               "--address",
                               options.connection.transport.address,
                               "--peers",
                               comma_separated(options.connection.transport.peers),
                               "--run-folder",
                               options.run_folder.string()};
  const auto add = [&out](const char* option, double number) {
    std::ostringstream text;
    text.precision(17);
    text << number;
    out.emplace_back(option);
    out.push_back(text.str());
  };
  const services::process::Connection& connection = options.connection;
  if (!connection.network.empty()) out.insert(out.end(), {"--network", connection.network.string()});
  if (!connection.keys.empty()) out.push_back("--secure=" + connection.keys.string());
  if (options.standby) out.emplace_back("--standby");
  add("--watchdog", options.watchdog_s);
  if (options.speed && *options.speed > 0) add("--speed", *options.speed);
  if (options.domain_given) add("--domain", options.connection.transport.domain);
  return out;
}

}  // namespace

ContinuedCommandLine continued_command_line(int argc, const char* const* argv) {
  std::vector<std::string> given(argv + 1, argv + argc);
  ContinuedCommandLine out;
  if (const fs::path folder = take_resumed_folder(given); !folder.empty()) {
    const json kept = read_file(folder);
    try {
      if (kept.at("clock").get<std::string>() != "live") {
        refuse(
            folder,
            "on the simulated clock the world ends with its run, and nobody can go on in it; only runs with "
            "--clock live are resumed");
      }
      out.arguments = kept.at("arguments").get<std::vector<std::string>>();
      out.continued = Continuation{kept.at("epoch_unix_us"), clock::anchor_of(kept.value("anchor", "")),
                                   kept.at("launchers")};
    } catch (const json::exception&) {
      refuse_damaged(folder);
    }
    out.earlier = out.arguments;
    std::ranges::reverse(out.earlier);
    const std::string there = fs::absolute(folder).lexically_normal().string();
    out.arguments.insert(out.arguments.end(), {"--run-folder", there});  // it may have been moved
  }
  out.arguments.insert(out.arguments.end(), given.begin(), given.end());
  std::ranges::reverse(out.arguments);
  return out;
}

void keep_command_line(const Options& options, const clock::HostAnchor& anchor, std::int64_t epoch_unix_us) {
  const json kept{{"format", kContinuationFormat},
                  {"clock", options.live ? "live" : "simulated"},
                  {"arguments", command_line_of(options)},
                  {"epoch_unix_us", epoch_unix_us},
                  {"anchor", to_text(anchor)},
                  {"launchers", (options.continued ? options.continued->launchers : 0) + 1}};
  durable::replace_file(options.run_folder / kContinuationFile, kept.dump(2) + "\n");
}

FolderLock::FolderLock(const fs::path& run_folder)
    : descriptor_(open((run_folder / kLockFile).c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0)
    throw std::system_error(errno, std::generic_category(),
                            "cannot open " + (run_folder / kLockFile).string());
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  close(descriptor_);
  throw std::invalid_argument("another roci-launch flies the run in " + run_folder.string() +
                              "; end it first");
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace roci::services::launch
