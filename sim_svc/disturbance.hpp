#pragma once
#include <string>
#include <variant>

#include "sim_svc/drive.hpp"

namespace roci::sim {

/// A component breaks: its task fails, and so does every new one until `until`.
struct ComponentFault {
  std::string component;
  Time until{};
};

/// A rock that no map shows is there from now on.
struct RockFall {
  Rock rock;
};

/// Energy is gone from the battery at once.
struct EnergyLoss {
  double joules = 0;
};

using Disturbance = std::variant<ComponentFault, RockFall, EnergyLoss>;

}  // namespace roci::sim
