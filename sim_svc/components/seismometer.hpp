// This is a seismometer, which records quakes beside all other work until it is parked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/hollow_commands.hpp"
#include "sim_svc/components/paced_work.hpp"
#include "sim_svc/components/products.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a seismometer (README.md); noises are standard deviations, as shares.
struct SeismometerSettings {
  double start_s = 600;  ///< to level it
  double park_s = 600;
  double switch_w = 5;
  double record_w = 5;
  double duration_noise = 0.05;
  double duration_factor = 1;
  double quakes_per_day = 20;         ///< on average; when they come, the seed says
  double quiet_share = 0.3;           ///< of the data that come without any quake
  double reference_s = 86400;         ///< for which the sizes of the products hold, at the average of quakes
  std::vector<ProductForm> products;  ///< made each time it is parked
};

/// Simulates a seismometer. It takes start and park. What it makes when it is parked grows with the time that it
/// recorded and with the quakes in it. Parked already, or recording already, it is done at once.
class Seismometer final : public world::Component {
 public:
  Seismometer(SeismometerSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return forms(); }
  static std::vector<world::CommandForm> forms() { return {{"start", {}}, {"park", {}}}; }
  std::vector<world::StateForm> state_forms() const override { return {{"parked"}, {"recording"}}; }
  /// Returns parked or recording; while it changes, it is what it was.
  temporal::State state() const override;
  bool busy() const override { return run_.has_value(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void slow_down(double pace, temporal::Time until, temporal::Time now, world::Surroundings&) override {
    work_.slow_down(pace, until, now);
  }
  void hollow_next(const std::string& command) override { hollow_.add(command); }
  void halt(temporal::Time, world::Surroundings&) override { run_.reset(); }

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override;
  /// Returns recorded_s and quakes of what was parked.
  std::map<std::string, temporal::Value> results() const override { return results_; }
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  world::Ending park(const world::TaskKey&, temporal::Time now, world::Surroundings&);
  double quakes_in(temporal::Time from, temporal::Time to) const;

  SeismometerSettings settings_;
  world::RandomStream noise_;
  PacedWork work_;
  std::optional<world::Task> run_;
  std::optional<temporal::Time> recording_since_{};
  HollowCommands hollow_;
  std::map<std::string, temporal::Value> results_;
};

}  // namespace roci::sim::components
