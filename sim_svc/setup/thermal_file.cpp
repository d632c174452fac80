#include "sim_svc/setup/thermal_file.hpp"

#include "sim_svc/setup/settings.hpp"

namespace roci::sim::setup {

using mission::Entry;

namespace {

world::ZoneParameters read_zone(const std::string& name, const Entry& entry) {
  entry.allow_only({"capacity_j_k", "loss_w_k", "heater_w", "keep_k", "work_k", "range_k", "start_k"});
  world::ZoneParameters out;
  check_name(name, entry);
  out.name = name;
  out.capacity_j_k = number(entry, "capacity_j_k", out.capacity_j_k, 1);
  out.loss_w_k = number(entry, "loss_w_k", out.loss_w_k, 1e-6);
  out.heater_w = number(entry, "heater_w", out.heater_w);
  out.keep_k = number(entry, "keep_k", out.keep_k);
  out.work_k = number(entry, "work_k", std::max(out.work_k, out.keep_k));
  out.start_k = number(entry, "start_k", out.keep_k);
  if (out.work_k < out.keep_k)
    entry.at("work_k").fail("a zone would be colder at work than at rest; raise work_k, or lower keep_k");
  if (const auto range = entry.find("range_k")) {
    const auto ends = range->items();
    if (ends.size() != 2) range->fail("expected [coldest, hottest], in K");
    out.least_k = ends[0].number();
    out.most_k = ends[1].number();
    if (out.least_k > out.keep_k || out.most_k < out.work_k)
      range->fail("the heater itself would leave the range; let it hold keep_k and work_k");
  }
  return out;
}

}  // namespace

double read_surroundings(const Entry& entry) {
  const double kelvin = entry.number();
  if (kelvin < kColdest || kelvin > kHottest)
    entry.fail("surroundings have " + std::to_string(kColdest) + " to " + std::to_string(kHottest) +
               " K; correct the number");
  return kelvin;
}

world::ThermalParameters read_thermal(const Entry& entry) {
  entry.allow_only({"surroundings_k", "waste_factor", "loss_factor", "zones"});
  world::ThermalParameters out;
  if (const auto surroundings = entry.find("surroundings_k"))
    out.surroundings_k = read_surroundings(*surroundings);
  out.waste_factor = number(entry, "waste_factor", out.waste_factor);
  out.loss_factor = number(entry, "loss_factor", out.loss_factor, kLeastFactor);
  entry.at("zones").each_field(
      [&](const std::string& name, const Entry& zone) { out.zones.push_back(read_zone(name, zone)); });
  return out;
}

}  // namespace roci::sim::setup
