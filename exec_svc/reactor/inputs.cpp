// What comes in from outside the running plan: services, models, goals.
#include "exec_svc/mission/template_text.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using goals::GoalRequest;
using goals::GoalSet;
using mission::fill_names;
using problem::Reserves;

using temporal::Time;

void Reactor::take_peers(const ReactorInputs& inputs) {
  for (const PeerLoss& loss : inputs.losses) {
    report(Severity::warning, "service.lost", loss.service + " was lost: " + loss.reason);
  }
  for (const std::string& service : inputs.arrivals) {
    report(Severity::info, "service.found", service + " is there");
    if (phase_ == MissionPhase::safe && !goals_.open().empty()) want_plan(service + " came back");
    failed_calls_ = 0;
    next_call_at_ = Time{0};
    fallbacks_sent_ = false;  // one that came back has not heard them
  }
}

void Reactor::take_models(const std::vector<ModelVersion>& models) {
  for (const ModelVersion& model : models) {
    const auto [known, is_new] = models_.try_emplace(model.owner, model.version);
    if (is_new || known->second == model.version) continue;
    known->second = model.version;
    models_changed_ = true;
  }
}

void Reactor::take_goals(Time now, const std::vector<GoalRequest>& requests) {
  for (const GoalRequest& request : goals_.in_reference_order(requests)) {
    const auto [taken, record] = goals_.submit(request, now);
    if (taken == GoalSet::Disposition::known) continue;
    out_.goal_changes.push_back(*record);
    const std::string name = "goal " + record->request.key.text();
    if (taken == GoalSet::Disposition::rejected) {
      report(Severity::warning, "goal.rejected", name + " rejected: " + record->reason);
    } else if (taken == GoalSet::Disposition::refused) {
      report(Severity::warning, "goal.refused", name + ": " + record->reason);
    } else if (taken == GoalSet::Disposition::recalled) {
      report(Severity::info, "goal.recalled", name + " recalled");
      if (phase_ == MissionPhase::executing || phase_ == MissionPhase::planning)
        want_plan(name + " was recalled");
    } else if (taken == GoalSet::Disposition::accepted) {
      report(Severity::info, "goal.accepted", name + " accepted");
      assume_unobserved(record->request);
      reserves_ = Reserves::kept;
      want_plan(name + " arrived");
    }
  }
}

void Reactor::assume_unobserved(const GoalRequest& goal) {
  const auto values = template_values(goal);
  for (const auto& [timeline, templates] : mission_->goal_kinds.at(goal.kind).unobserved) {
    std::vector<std::string> facts;
    for (const std::string& fact : templates) facts.push_back(fill_names(fact, values));
    beliefs_.assume(fill_names(timeline, values), std::move(facts));
  }
}

}  // namespace roci::exec::reactor
