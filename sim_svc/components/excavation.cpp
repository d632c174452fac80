#include "sim_svc/components/excavation.hpp"

#include <algorithm>
#include <cmath>

namespace roci::sim::components {

IceColumn::IceColumn(const Ice& ice, double depth_m, world::RandomStream noise)
    : wanted_(depth_m), bottom_(std::min(depth_m, ice.deepest_m.value_or(depth_m))), layer_m_(ice.layer_m) {
  const double layers = std::clamp(std::ceil(depth_m / layer_m_), 1.0, kMostLayers);
  for (std::size_t i = 0; i < static_cast<std::size_t>(layers); ++i)
    energies_.push_back(ice.specific_energy_j_m3 * std::exp(ice.layer_noise * noise.normal()));
}

std::size_t IceColumn::layer_at(double depth_m) const {
  const double layer = std::floor(std::max(0.0, depth_m) / layer_m_);
  return static_cast<std::size_t>(std::min(layer, static_cast<double>(energies_.size() - 1)));
}

double IceColumn::specific_energy_j_m3(double depth_m) const { return energies_[layer_at(depth_m)]; }

double IceColumn::cutting_s(double from_m, double to_m, const Cutter& cutter) const {
  double joules_m2 = 0;
  std::size_t layer = layer_at(from_m);
  for (double top = from_m; top < to_m; ++layer) {
    const bool last = layer + 1 >= energies_.size();
    const double floor = last ? to_m : std::min(to_m, static_cast<double>(layer + 1) * layer_m_);
    joules_m2 += energies_[std::min(layer, energies_.size() - 1)] * std::max(0.0, floor - top);
    top = std::max(top, floor);
  }
  return joules_m2 * cutter.area_m2 / cutter.power_w;
}

double IceColumn::depth_after(double from_m, double cutting_s, const Cutter& cutter) const {
  double left_j_m2 = cutting_s * cutter.power_w / cutter.area_m2;
  double depth = from_m;
  for (std::size_t layer = layer_at(from_m); depth < bottom_; ++layer) {
    const bool last = layer + 1 >= energies_.size();
    const double energy = energies_[std::min(layer, energies_.size() - 1)];
    const double floor = last ? bottom_ : std::min(bottom_, static_cast<double>(layer + 1) * layer_m_);
    const double needed = energy * std::max(0.0, floor - depth);
    if (needed >= left_j_m2) return depth + left_j_m2 / energy;
    left_j_m2 -= needed;
    depth = std::max(depth, floor);
  }
  return std::max(from_m, bottom_);
}

}  // namespace roci::sim::components
