#include "sim_svc/world/disturbance.hpp"

namespace roci::sim::world {

bool adds_up(const Disturbance& what) {
  if (const auto* mishap = std::get_if<ComponentMishap>(&what))
    return std::holds_alternative<TrenchCollapse>(mishap->what);
  return std::holds_alternative<EnergyLoss>(what) || std::holds_alternative<EnergyDrop>(what) ||
         std::holds_alternative<SuddenHeat>(what) || std::holds_alternative<HollowSuccess>(what);
}

}  // namespace roci::sim::world
