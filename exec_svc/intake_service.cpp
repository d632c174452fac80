#include "exec_svc/intake_service.hpp"

#include <algorithm>
#include <utility>

#include "exec_svc/limits.hpp"

namespace roci::exec {

using goals::GoalRequest;
using goals::GoalState;
using reactor::Event;
using reactor::GivenAnswer;
using reactor::ModelVersion;
using reactor::Severity;

Intake::Intake(const mission::MissionModel& mission, const reactor::Reactor& reactor, Report report)
    : mission_(&mission), reactor_(&reactor), report_(std::move(report)) {
  for (const goals::GoalRecord* record : reactor.goals().all()) goals_.insert(record->request.key.text());
  for (const orders::OrderStatus& status : reactor.order_statuses()) orders_.insert(status.key.text());
  for (const reactor::AnswerReceipt& receipt : reactor.answer_receipts()) answers_.insert(receipt.key.text());
  for (const auto& [timeline, value] : reactor.observed())
    (is_of_mission(timeline) ? timelines_ : foreign_timelines_).insert(timeline);
}

bool Intake::admits(const GoalRequest& goal, const std::vector<GoalRequest>& waiting, temporal::Time now) {
  const std::string name = goal.key.text();
  if (goals_.contains(name)) return true;
  if (goals_.size() >= kRejectedGoals && !has_room_for(goal, waiting, now))
    return refuse("goal.no_room", "goal " + name.substr(0, kNameBytes) +
                                      " is not taken: it would be rejected, and " +
                                      std::to_string(kRejectedGoals) + " rejected goals are kept already");
  return enter(goals_, name, kGoals, "goal.no_room", "goal");
}

bool Intake::has_room_for(const GoalRequest& goal, const std::vector<GoalRequest>& waiting,
                          temporal::Time now) {
  if (!sieve_ || ++sieved_ >= kRejectedGoals) {
    sieve_.emplace(reactor_->goals());
    for (const GoalRequest& one : waiting) sieve_->submit(one, now);
    sieved_ = 0;
    const auto all = sieve_->all();
    rejected_ =
        static_cast<std::size_t>(std::ranges::count(all, GoalState::rejected, &goals::GoalRecord::state));
  }
  if (sieve_->submit(goal, now).taken != goals::GoalSet::Disposition::rejected) return true;
  return rejected_++ < kRejectedGoals;
}

bool Intake::admits(const orders::Order& order) {
  const bool safe = order.kind == orders::OrderKind::safe;
  return enter(orders_, order.key.text(), kOrders + (safe ? kSafeOrders : 0), "order.no_room", "order");
}

bool Intake::admits(const GivenAnswer& answer) {
  return enter(answers_, answer.key.text(), kAnswers, "answer.no_room", "answer");
}

bool Intake::is_of_mission(const std::string& timeline) const {
  const auto is_it = [&](const auto& model) { return model.timeline == timeline; };
  return std::ranges::any_of(mission_->components, is_it) || std::ranges::any_of(mission_->windows, is_it) ||
         std::ranges::any_of(mission_->fluents, is_it) ||
         std::ranges::any_of(mission_->families, [&](const mission::TimelineFamily& family) {
           return timeline.starts_with(family.prefix);
         });
}

bool Intake::admits_timeline(const std::string& timeline) {
  std::set<std::string>& known = is_of_mission(timeline) ? timelines_ : foreign_timelines_;
  return enter(known, timeline, kTimelines, "timeline.no_room", "timeline");
}

bool Intake::admits(const ModelVersion& model) {
  return enter(owners_, model.owner, kModelOwners, "model.no_room", "owner of a model");
}

bool Intake::enter(std::set<std::string>& known, const std::string& name, std::size_t room, const char* code,
                   const char* what) {
  if (known.contains(name)) return true;
  if (name.size() > kNameBytes)
    return refuse(code, std::string(what) + " " + name.substr(0, 64) +
                            "… is not taken: its name has more than " + std::to_string(kNameBytes) +
                            " bytes");
  if (known.size() >= room)
    return refuse(code, std::string(what) + " " + name + " is not taken: " + std::to_string(room) +
                            " are kept already");
  known.insert(name);
  return true;
}

bool Intake::refuse(const char* code, const std::string& text) {
  tell({Severity::warning, code, text});
  return false;
}

void Intake::tell(Event event) {
  const std::uint64_t count = tally_.note(event.code);
  if (count == 0) return;
  if (count > 1) event.text += " (" + std::to_string(count) + " so far)";
  report_(event);
}

}  // namespace roci::exec
