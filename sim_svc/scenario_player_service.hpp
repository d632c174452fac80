// The scenario player lets happen what the scenario says, each stimulus at its time: the ground's goals, hazards and
// orders go out, and what befalls the world is handed on.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "roci_idl/goal.h"
#include "roci_idl/map.h"
#include "roci_idl/network.h"
#include "roci_idl/order.h"
#include "services/node.hpp"
#include "services/publisher.hpp"
#include "sim_svc/scenario/scenario.hpp"

namespace roci::sim {

/// Plays a scenario once, in order of time.
class ScenarioPlayer {
 public:
  /// `disturb` brings a disturbance about that is due at the given time, and `played` hears after each stimulus that it
  /// is over. Node and publisher must outlive this object.
  struct Hooks {
    std::function<void(temporal::Time, const world::Disturbance&)> disturb;
    std::function<void()> played;
  };
  ScenarioPlayer(services::Node& node, scenario::Scenario scenario, services::Publisher<v1::Hazard>& hazards,
                 Hooks hooks);
  ScenarioPlayer(const ScenarioPlayer&) = delete;
  ScenarioPlayer& operator=(const ScenarioPlayer&) = delete;

  /// Sets a timer for each stimulus.
  void begin();
  const scenario::Scenario& scenario() const { return scenario_; }
  bool is_over() const { return played_ == scenario_.stimuli.size(); }

 private:
  void play(const scenario::Stimulus& stimulus);

  services::Node& node_;
  const scenario::Scenario scenario_;
  services::Publisher<v1::Hazard>& hazards_;
  Hooks hooks_;
  services::Publisher<v1::Goal> goals_;
  services::Publisher<v1::NetworkOrder> network_orders_;
  std::optional<services::Publisher<v1::Order>> orders_;  // of scenarios in which the ground gives some
  std::map<std::pair<std::string, std::string>, const scenario::GoalStimulus*> uploaded_;  // by issuer and id
  std::size_t played_ = 0;
};

/// Returns the scenario's first order of the ground; null: there is none.
const scenario::Stimulus* first_order(const scenario::Scenario& scenario);

}  // namespace roci::sim
