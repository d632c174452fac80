// mission.yaml is a file of a stated format (docs/formats.md publishes its schema).
#pragma once

#include <filesystem>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Numbers the newest format of mission.yaml that this code reads. It rises when a key changes its meaning or
/// goes.
inline constexpr int kMissionFormat = 1;

/// Returns the file that a service reads: the file itself, or the mission.yaml of a folder.
std::filesystem::path mission_file(const std::filesystem::path& folder_or_file);

/// Reads a mission file; one that states no `format` is of format 1. What it does not say itself is as in the file that
/// its key `base` names, if it has one (Entry::with_base). Throws FileError, also for a file of a newer format, which
/// is never misread, and for a base that is missing, the file itself or one that has a base. `findings` as in
/// Entry::load().
Entry load_mission_file(const std::filesystem::path& folder_or_file, Findings* findings = nullptr);

}  // namespace roci::mission
