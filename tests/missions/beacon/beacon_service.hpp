// A warning light as a user of Rocinante would drive it: an owner of commands on the kit alone.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::beacon {

// One beacon of the robot that the service belongs to: its timeline is ROBOT.beacon.
std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings);

}  // namespace roci::beacon
