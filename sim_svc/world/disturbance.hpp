#pragma once
#include <optional>
#include <string>
#include <variant>

#include "sim_svc/world/environment.hpp"

namespace roci::sim::world {

/// Breaks a component: its task fails, and so does every new one until `until`. With a pace its tasks get on until
/// then at this share of their usual speed instead, at 0 not at all.
struct ComponentFault {
  std::string robot;
  std::string component;
  temporal::Time until{};
  std::optional<double> pace{};  ///< 0 … 1; only for a component that can be slowed
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
