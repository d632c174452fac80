#pragma once
#include <string>
#include <variant>

#include "sim_svc/world/environment.hpp"

namespace roci::sim::world {

/// A component breaks: its task fails, and so does every new one until `until`.
struct ComponentFault {
  std::string robot;
  std::string component;
  temporal::Time until{};
};

/// A rock that no map shows is there from now on.
struct RockFall {
  Rock rock;
};

/// Energy is gone from the robot's battery at once.
struct EnergyLoss {
  std::string robot;
  double joules = 0;
};

using Disturbance = std::variant<ComponentFault, RockFall, EnergyLoss>;

}  // namespace roci::sim::world
