#pragma once
#include <string>
#include <variant>

#include "sim_svc/world/environment.hpp"

namespace roci::sim::world {

/// Breaks a component: its task fails, and so does every new one until `until`.
struct ComponentFault {
  std::string robot;
  std::string component;
  temporal::Time until{};
};

/// Puts a rock that no map shows there from now on.
struct RockFall {
  Rock rock;
};

/// Takes energy from the robot's battery at once.
struct EnergyLoss {
  std::string robot;
  double joules = 0;
};

using Disturbance = std::variant<ComponentFault, RockFall, EnergyLoss>;

}  // namespace roci::sim::world
