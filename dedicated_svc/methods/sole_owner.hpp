// A timeline has one owner; this file says what a dedicated executive may not show, because the mission gives it to
// another service.
#pragma once

#include <filesystem>
#include <string>

#include "core/mission/entry.hpp"

namespace roci::dedicated::methods {

/// Reads mission.yaml of the folder, if there is one, and the settings of its other dedicated executives. Throws
/// mission::FileError, at `timeline` of the section `dedicated`, if a component with this timeline has another owner
/// than the service `name`, or if there is no such component and one of the others shows the timeline, too.
void check_sole_owner(const mission::Entry& dedicated, const std::filesystem::path& mission_folder,
                      const std::string& name);

}  // namespace roci::dedicated::methods
