#include "sim_svc/world/cold_part.hpp"

#include <cmath>

namespace roci::sim::world {

std::optional<Warming> warming(const ColdPart& part, double surroundings_k, double loss_factor) {
  const double loss_w_k = part.loss_w_k * loss_factor;
  const double holding_w = loss_w_k * (part.work_k - surroundings_k);
  if (holding_w <= 0) return Warming{};  // it is warm already
  if (holding_w >= part.heater_w) return std::nullopt;
  const double tau_s = part.capacity_j_k / loss_w_k;
  return Warming{tau_s * std::log(part.heater_w / (part.heater_w - holding_w)), holding_w};
}

}  // namespace roci::sim::world
