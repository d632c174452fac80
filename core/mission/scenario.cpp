#include "core/mission/scenario.hpp"

#include <algorithm>
#include <vector>

#include "core/words/nearest_word.hpp"

namespace roci::mission {
namespace {

std::filesystem::path scenarios_folder(const std::filesystem::path& folder_or_file) {
  return mission_file(folder_or_file).parent_path() / "scenarios";
}

}  // namespace

std::vector<std::string> scenario_names(const std::filesystem::path& folder_or_file) {
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& file : std::filesystem::directory_iterator(scenarios_folder(folder_or_file), missing)) {
    if (file.path().extension() == ".yaml") names.push_back(file.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Entry load_scenario(const std::filesystem::path& folder_or_file, const std::string& name,
                    Findings* findings) {
  const auto file = scenarios_folder(folder_or_file) / (name + ".yaml");
  if (std::filesystem::exists(file)) return Entry::load(file, findings);
  const auto names = scenario_names(folder_or_file);
  std::string all;
  for (const std::string& one : names) all += (all.empty() ? "" : ", ") + one;
  if (names.empty()) throw FileError(file.string() + ": the mission has no scenario; write this one");
  throw FileError(file.string() + ": there is no such scenario; choose one of: " + all +
                  words::did_you_mean(name, names));
}

}  // namespace roci::mission
