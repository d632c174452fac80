#include "core/mission/scenario.hpp"

#include <algorithm>
#include <vector>

namespace roci::mission {
namespace {

std::string scenarios_of(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& file : std::filesystem::directory_iterator(folder, missing)) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem());
  }
  std::sort(names.begin(), names.end());
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out.empty() ? "none" : out;
}

}  // namespace

Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name) {
  const auto folder = mission_file(folder_or_file).parent_path() / "scenarios";
  const auto file = folder / (name + ".yaml");
  if (std::filesystem::exists(file)) return Entry::load(file);
  throw FileError(file.string() + ": there is no such scenario; choose one of: " + scenarios_of(folder));
}

}  // namespace roci::mission
