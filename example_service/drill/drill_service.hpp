// A drill as its maker would drive it: the owner of a function, of a component and of its commands.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace borehole {

// Owns bore_time of the domain's module `drill`, the timelines ROBOT.drill and
// ROBOT.drill.hole.*, and the command `bore`.
std::unique_ptr<roci::services::Service> make_drill(roci::services::Node& node,
                                                    const roci::services::RunSettings& settings);

}  // namespace borehole
