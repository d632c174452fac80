// This is what components share whose tasks run through phases.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim_svc/components/hollow_commands.hpp"
#include "sim_svc/components/phased_task.hpp"
#include "sim_svc/world/component.hpp"

namespace roci::sim::components {

/// Simulates a component whose tasks have phases in one thermal zone; they can be slowed, and succeed without
/// effect.
class PhasedComponent : public world::Component {
 public:
  bool busy() const override { return phases_.busy(); }
  std::optional<temporal::Time> next_change() const override { return phases_.next_change(); }
  void slow_down(double pace, temporal::Time until, temporal::Time now, world::Surroundings&) override {
    phases_.slow_down(pace, until, now);
  }
  void hollow_next(const std::string& command) override { hollow_.add(command); }
  void settle(temporal::Time now, world::Body& body) override { phases_.settle(now, body); }
  void surroundings_changed(temporal::Time now, world::Surroundings& around) override {
    phases_.settle(now, around.body);
  }
  double energy_j(temporal::Time from, temporal::Time to) const override {
    return phases_.energy_j(from, to);
  }
  double peak_power_w() const override { return phases_.peak_power_w(); }
  std::vector<std::string> zones() const override {
    if (phases_.zone().empty()) return {};
    return {phases_.zone()};
  }
  std::string held_zone() const override { return busy() ? phases_.zone() : ""; }

 protected:
  explicit PhasedComponent(std::string zone) : phases_(std::move(zone)) {}

  PhasedTask phases_;
  HollowCommands hollow_;
};

}  // namespace roci::sim::components
