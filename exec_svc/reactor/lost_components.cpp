#include "exec_svc/reactor/lost_components.hpp"

#include <algorithm>

namespace roci::exec::reactor {

using executive::Observation;
using mission::Component;
using temporal::Time;

namespace {

bool needs(const Component& component, const std::string& service) {
  return component.lost &&
         std::ranges::find(component.lost->without, service) != component.lost->without.end();
}

}  // namespace

std::vector<Observation> LostComponents::step(Time now, const ReactorInputs& inputs) {
  const auto& components = state_->mission->components;
  for (const PeerLoss& loss : inputs.losses)
    if (std::ranges::any_of(components, [&](const Component& one) { return needs(one, loss.service); }))
      away_since_.try_emplace(loss.service, now);
  for (const std::string& service : inputs.arrivals) away_since_.erase(service);
  awaited_until_.reset();
  std::vector<Observation> out;
  for (const Component& component : components) {
    if (!component.lost) continue;
    const std::pair<const std::string, Time>* first = nullptr;
    for (const auto& away : away_since_)
      if (needs(component, away.first) && (first == nullptr || away.second < first->second)) first = &away;
    if (first == nullptr) {
      lost_.erase(component.name);
    } else if (const Time due = first->second + component.lost->after; now < due) {
      awaited_until_ = std::max(awaited_until_.value_or(due), due);
      state_->wake_at(due);
    } else {
      out.push_back(count_as_lost(component, first->first));
    }
  }
  return out;
}

Observation LostComponents::count_as_lost(const Component& component, const std::string& service) {
  if (lost_.insert(component.name).second) {
    safing_->forget(component.name);
    state_->report(Severity::error, "component.lost",
                   component.name + " counts as " + temporal::to_text(temporal::Value(component.lost->as)) +
                       ": " + service + " has not come back for " +
                       std::to_string(static_cast<long>(temporal::to_seconds(component.lost->after))) + " s");
  }
  return {component.timeline, component.lost->as};
}

void LostComponents::hold_planning() {
  if (awaited_until_) call_->wait_until(std::max(call_->not_before(), *awaited_until_));
}

}  // namespace roci::exec::reactor
