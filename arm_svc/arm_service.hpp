// This is the arm's process: what it answers and moves, over DDS.
#pragma once
#include <memory>

#include "services/service.hpp"

namespace roci::arm {

/// Makes the owner of the mission's arm functions and of arm motions (README.md). Throws mission::FileError when the
/// mission's arm cannot be read.
std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings);

}  // namespace roci::arm
