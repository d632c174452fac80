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

// One level only: what a mission is made of stands in two files at most, so that a reader finds it.
Entry load_base(const Entry& name, Findings* findings) {
  const std::filesystem::path file = name.resolve(name.text());
  std::error_code error;
  if (std::filesystem::equivalent(file, name.file(), error))
    name.fail("the file is a base of itself; name another one, or leave 'base' out");
  if (!std::filesystem::is_regular_file(file, error))
    name.fail("there is no base file " + file.string() +
              "; correct the name, which is relative to this file");
  Entry base = Entry::load(file, findings);
  if (const auto next = base.find("base"))
    next->fail("the base of " + name.file().string() +
               " has a base itself; name that one there, or leave it out here");
  require_known_format(base);
  return base;
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
  const auto base = mission.find("base");
  return base ? mission.with_base(load_base(*base, findings)) : mission;
}

}  // namespace roci::mission
