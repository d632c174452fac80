// The thermal model says how warm the parts of a robot are, and what keeps them so.
#pragma once
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"

namespace roci::sim::world {

/// Describes a part of a robot that has one temperature, with a heater that a thermostat switches.
struct ZoneParameters {
  std::string name;
  double capacity_j_k = 20000;  ///< above 0
  double loss_w_k = 0.5;        ///< to the surroundings, above 0
  double heater_w = 100;        ///< the most that the heater gives
  double keep_k = 150;          ///< the heater never lets it get colder, if it can
  double work_k = 220;          ///< temperature for work; at least keep_k
  double least_k = 0;           ///< colder is out of range
  double most_k = std::numeric_limits<double>::infinity();  ///< hotter is out of range
  double start_k = 150;
};

/// Describes the heat of a robot.
struct ThermalParameters {
  double surroundings_k = 100;
  double waste_factor = 1;  ///< factor on all waste heat that components report
  double loss_factor = 1;   ///< factor on the zones' own losses
  std::vector<ZoneParameters> zones;
};

/// Holds the temperatures of a robot's zones as functions of time. A zone loses heat in proportion to how much warmer
/// it is than the surroundings (Newton), and gains its heater's and the waste heat of what works in it. Its heater
/// brings it to keep_k at full power, to work_k while anybody holds it for work, and then gives what just holds that.
/// Between changes all is an exponential in closed form, so that nothing depends on how time is sliced. Times never lie
/// before those of earlier calls. The zones that are named must be there.
class Thermal {
 public:
  explicit Thermal(ThermalParameters);

  bool has(std::string_view zone) const;
  const std::vector<ZoneParameters>& zones() const { return parameters_.zones; }
  double surroundings_k() const { return parameters_.surroundings_k; }
  double loss_factor() const { return parameters_.loss_factor; }

  /// Keeps the zone warm for work from now on; `who` is any object that stands for whoever does.
  void hold(std::string_view zone, const void* who, temporal::Time now);
  /// Releases the zone, and removes the waste heat of the same object.
  void release(std::string_view zone, const void* who, temporal::Time now);
  bool held(std::string_view zone) const;
  /// Sets the heat that the object leaves in the zone, in W.
  void set_waste(std::string_view zone, const void* who, double watts, temporal::Time now);
  /// Returns when the zone is as warm as its work needs, as things stand: `now` if it is, nothing if it will never be.
  std::optional<temporal::Time> ready_at(std::string_view zone, temporal::Time now) const;

  double temperature_k(std::string_view zone, temporal::Time) const;
  bool in_range(std::string_view zone, temporal::Time) const;
  /// Returns what the zone's heater gives in [from, to), in J. Nothing has changed since `from`.
  double heater_j(std::string_view zone, temporal::Time from, temporal::Time to) const;
  /// Returns the power of all heaters at once, in W.
  double peak_power_w() const;

  void set_surroundings(double kelvin, temporal::Time now);
  /// Heats the zone at once, or, negative, cools it; not below 0 K.
  void add_heat(std::string_view zone, double joules, temporal::Time now);

  /// Returns the temperatures by zone, in K.
  std::map<std::string, double> memory(temporal::Time now) const;
  /// Goes on from such temperatures at `at`; zones that are not there change nothing.
  void restore(const std::map<std::string, double>&, temporal::Time at);

 private:
  // One exponential: from `from_k` towards `towards_k`, with a constant power of the heater.
  struct Leg {
    double from_k = 0;
    double towards_k = 0;
    double heater_w = 0;
  };
  struct Zone {
    std::vector<const void*> holders;
    std::vector<std::pair<const void*, double>> waste_w;  // in the order in which it began
    temporal::Time since{};
    Leg first;           // until the thermostat's temperature is reached
    double first_s = 0;  // how long; infinite: it never is
    Leg then;            // from there on
  };

  std::size_t index(std::string_view zone) const;
  double loss_w_k(std::size_t) const;
  double tau_s(std::size_t) const;
  double waste_w(std::size_t) const;
  double goal_k(std::size_t) const;
  double temperature_k(std::size_t, temporal::Time) const;
  Leg held_at(std::size_t, double kelvin) const;
  void set_out(std::size_t, double from_k, temporal::Time now);
  void change(std::size_t zone, temporal::Time now) { set_out(zone, temperature_k(zone, now), now); }

  ThermalParameters parameters_;
  std::vector<Zone> zones_;  // one per parameter
};

}  // namespace roci::sim::world
