// This is a simulated battery: what charges and drains it, and what its gauge shows.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Describes day and night of a body in orbit: the sun is gone for `eclipse_s` of every `orbit_s`.
struct Orbit {
  double orbit_s = 5700;
  double eclipse_s = 2100;            ///< below orbit_s
  double first_eclipse_s = 3600;      ///< mission time at which the first eclipse begins
  double solar_w = 0;                 ///< of the panel in sunlight
  std::string window = "sun.window";  ///< timeline of the window that is open in sunlight
};

/// Returns how many seconds of [from, to) lie in sunlight.
double sunlit_s(const Orbit&, temporal::Time from, temporal::Time to);

/// Returns the intervals of sunlight that begin before `end`, ascending.
std::vector<std::pair<temporal::Time, temporal::Time>> sunlight(const Orbit&, temporal::Time end);

/// Describes the gauge of a battery: below `below_j` it falls `factor` times as fast as the charge does, but
/// not below 0. The true charge is unaffected.
struct Gauge {
  double below_j = 0;
  double factor = 1;
};

/// Returns what the gauge tells of a charge, in J.
double told_j(const Gauge&, double energy_j);

/// Describes a robot's store of energy and what always draws from it or charges it.
struct PowerParameters {
  double capacity_j = 1000000;
  double idle_w = 14;           ///< drawn all the time
  double solar_peak_w = 0;      ///< 0: there is no panel
  double solar_noon_s = 21600;  ///< mission time of the highest sun
  double day_s = 88775;         ///< length of a day, by default a Martian one
  /// Replaces the panel and the day above.
  std::optional<Orbit> orbit{};
  double use_factor = 1;  ///< of all that is drawn, as against what the parts would need
  Gauge gauge{};
};

/// Returns whether there is a panel that can charge it.
bool has_panel(const PowerParameters&);

/// Returns the power of the panel in W: the positive half of a cosine over the day.
double solar_power_w(const PowerParameters&, temporal::Time);

/// Returns what the panel gives in [from, to), in J: exactly for an orbit, else the power in the middle times the
/// duration.
double solar_energy_j(const PowerParameters&, temporal::Time from, temporal::Time to);

/// Models an ideal store between 0 and its capacity.
class Battery {
 public:
  Battery(double energy_j, double capacity_j);
  double energy_j() const { return energy_j_; }
  bool full() const { return energy_j_ >= capacity_j_; }
  /// Adds (or, negative, takes) energy; what does not fit is lost.
  void add(double joules);
  /// Returns true from the moment the store is empty until it holds a hundredth of its capacity again.
  bool flat() const { return flat_; }

 private:
  double energy_j_;
  double capacity_j_;
  bool flat_ = false;
};

}  // namespace roci::sim::world
