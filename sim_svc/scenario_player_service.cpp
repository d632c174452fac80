#include "sim_svc/scenario_player_service.hpp"

#include <algorithm>
#include <variant>

#include "services/topics/topics.hpp"
#include "sim_svc/wire_service.hpp"
#include "sim_svc/world/match.hpp"

namespace roci::sim {

using scenario::GoalStimulus;
using scenario::HazardStimulus;
using scenario::NetworkStimulus;
using scenario::OrderStimulus;
using scenario::RecallStimulus;
using scenario::Scenario;
using scenario::Stimulus;
using world::Match;

namespace {

namespace topics = services::topics;

constexpr char kGround[] = "ground";  // who tells of hazards that the scenario states

}  // namespace

const Stimulus* first_order(const Scenario& scenario) {
  const auto orders = [](const Stimulus& stimulus) {
    return std::holds_alternative<OrderStimulus>(stimulus.what);
  };
  const auto found = std::ranges::find_if(scenario.stimuli, orders);
  return found == scenario.stimuli.end() ? nullptr : &*found;
}

ScenarioPlayer::ScenarioPlayer(services::Node& node, Scenario scenario,
                               services::Publisher<v1::Hazard>& hazards, Hooks hooks)
    : node_(node),
      scenario_(std::move(scenario)),
      hazards_(hazards),
      hooks_(std::move(hooks)),
      goals_(services::advertise(node, topics::goal)),
      network_orders_(services::advertise(node, topics::network_order)) {}

void ScenarioPlayer::begin() {
  // In a secure run orders are the console's, so only who needs this asks for it.
  if (first_order(scenario_) != nullptr) orders_.emplace(services::advertise(node_, topics::order));
  for (const Stimulus& stimulus : scenario_.stimuli) {
    node_.at(stimulus.at, [this, &stimulus] { play(stimulus); });
  }
}

void ScenarioPlayer::play(const Stimulus& stimulus) {
  ++played_;
  std::visit(Match{[this](const GoalStimulus& goal) {
                     uploaded_[{goal.issuer, goal.id}] = &goal;
                     goals_.write(wire::to_wire(goal, false));
                   },
                   [this](const RecallStimulus& recall) {
                     goals_.write(wire::to_wire(*uploaded_.at({recall.issuer, recall.id}), true));
                   },
                   [this](const HazardStimulus& hazard) {
                     const world::Rock& rock = hazard.rock;
                     hazards_.write(wire::to_wire(
                         world::RockSeen{hazard.id, "", rock.x, rock.y, rock.radius, node_.now()}, kGround));
                   },
                   [this](const NetworkStimulus& order) { network_orders_.write(wire::to_wire(order)); },
                   [this](const OrderStimulus& order) { orders_->write(wire::to_wire(order)); },
                   [this, &stimulus](const world::Disturbance& disturbance) {
                     hooks_.disturb(stimulus.at, disturbance);
                   }},
             stimulus.what);
  hooks_.played();
}

}  // namespace roci::sim
