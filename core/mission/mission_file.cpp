#include "core/mission/mission_file.hpp"

#include <string>

namespace roci::mission {
namespace {

void require_known_format(const Entry& mission) {
  const auto format = mission.find("format");
  if (!format) return;
  const std::int64_t stated = format->integer();
  if (stated < 1) format->fail("the format is a whole number from 1; write 'format: 1'");
  if (stated > kMissionFormat) {
    format->fail("the file is of format " + std::to_string(stated) + ", this version reads up to " +
                 std::to_string(kMissionFormat) + "; fly it with the version that it was written for");
  }
}

}  // namespace

std::filesystem::path mission_file(const std::filesystem::path& folder_or_file) {
  std::error_code error;
  return std::filesystem::is_regular_file(folder_or_file, error) ? folder_or_file
                                                                 : folder_or_file / "mission.yaml";
}

Entry load_mission_file(const std::filesystem::path& folder_or_file, Findings* findings) {
  Entry mission = Entry::load(mission_file(folder_or_file), findings);
  require_known_format(mission);
  return mission;
}

}  // namespace roci::mission
