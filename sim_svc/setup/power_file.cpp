#include "sim_svc/setup/power_file.hpp"

#include "sim_svc/setup/settings.hpp"

namespace roci::sim::setup {

using mission::Entry;

namespace {

constexpr double kShortestOrbit = 60;  // s

world::Orbit read_orbit(const Entry& entry) {
  entry.allow_only({"orbit_s", "eclipse_s", "first_eclipse_s", "solar_w", "window"});
  world::Orbit out;
  out.orbit_s = number(entry, "orbit_s", out.orbit_s, kShortestOrbit);
  out.eclipse_s = number(entry, "eclipse_s", out.eclipse_s);
  out.first_eclipse_s = number(entry, "first_eclipse_s", out.first_eclipse_s);
  out.solar_w = number(entry, "solar_w", out.solar_w);
  out.window = entry.text_or("window", out.window);
  if (out.eclipse_s >= out.orbit_s)
    entry.find("eclipse_s")
        .value_or(entry)
        .fail("the eclipse would last as long as the orbit; shorten it, or lengthen orbit_s");
  return out;
}

}  // namespace

world::Gauge read_gauge(const Entry& entry) {
  entry.allow_only({"below_j", "factor"});
  return {number(entry, "below_j", 0), number(entry, "factor", 1)};
}

world::PowerParameters read_power(const Entry& entry) {
  entry.allow_only(
      {"capacity_j", "idle_w", "solar_peak_w", "solar_noon_s", "day_s", "orbit", "use_factor", "gauge"});
  world::PowerParameters out;
  if (const auto orbit = entry.find("orbit")) {
    for (const char* key : {"solar_peak_w", "solar_noon_s", "day_s"})
      if (const auto day = entry.find(key))
        day->fail("a robot in orbit has no day of a planet; drop " + std::string(key) + ", or orbit");
    out.orbit = read_orbit(*orbit);
  }
  out.capacity_j = number(entry, "capacity_j", out.capacity_j, 1);
  out.idle_w = number(entry, "idle_w", out.idle_w);
  out.solar_peak_w = number(entry, "solar_peak_w", out.solar_peak_w);
  out.solar_noon_s = number(entry, "solar_noon_s", out.solar_noon_s);
  out.day_s = number(entry, "day_s", out.day_s, 1);
  out.use_factor = number(entry, "use_factor", out.use_factor);
  if (const auto gauge = entry.find("gauge")) out.gauge = read_gauge(*gauge);
  return out;
}

}  // namespace roci::sim::setup
