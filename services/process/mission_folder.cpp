#include "services/process/mission_folder.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;

bool is_mission(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "mission.yaml", error);
}

std::vector<std::string> missions_in(const fs::path& library) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(library, error)) {
    if (is_mission(entry.path())) names.push_back(entry.path().filename().string());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<fs::path> mission_libraries() {
  std::vector<fs::path> libraries{fs::current_path() / "missions"};
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return libraries;
  libraries.push_back(bin.parent_path() / "share" / "rocinante" / "missions");      // installed
  libraries.push_back(bin.parent_path().parent_path().parent_path() / "missions");  // build/PRESET/bin
  return libraries;
}

fs::path mission_folder(const std::string& mission) {
  if (is_mission(mission)) return fs::absolute(mission).lexically_normal();
  std::string known;
  for (const fs::path& library : mission_libraries()) {
    if (is_mission(library / mission)) return library / mission;
    for (const std::string& name : missions_in(library)) {
      if (known.find(name) == std::string::npos) known += " " + name;
    }
  }
  throw std::invalid_argument(
      "no mission \"" + mission +
      "\": give a folder with a mission.yaml, or one of:" + (known.empty() ? " (none installed)" : known));
}

}  // namespace roci::services::process
