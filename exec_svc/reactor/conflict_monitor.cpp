#include "exec_svc/reactor/conflict_monitor.hpp"

#include <algorithm>

#include "exec_svc/reactor/conjuncts.hpp"

namespace roci::exec::reactor {
namespace {

using temporal::ActivityState;
using temporal::Condition;
using temporal::ConditionNode;
using temporal::Time;
using temporal::Truth;
using temporal::Value;

bool asks_for_a_state(const ConditionNode& node) {
  return std::holds_alternative<bool>(node.operand) || std::holds_alternative<temporal::State>(node.operand);
}

temporal::Lookup only(const Value& value) {
  return [&value](const std::string&) { return std::optional(value); };
}

std::set<std::string> activities_of_choices(const temporal::FlexiblePlan& plan) {
  std::set<std::string> out;
  for (const temporal::DecisionPoint& decision : plan.decisions)
    for (const temporal::DecisionChoice& choice : decision.choices)
      out.insert(choice.activities.begin(), choice.activities.end());
  return out;
}

}  // namespace

ConflictMonitor::ConflictMonitor(const temporal::FlexiblePlan& plan, const std::set<std::string>& foreseen,
                                 temporal::Duration lasting)
    : lasting_(lasting),
      states_(plan.activities.size(), ActivityState::waiting),
      touched_by_(plan.activities.size()) {
  const std::set<std::string> open_choices = activities_of_choices(plan);
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const temporal::PlanActivity& activity = plan.activities[i];
    index_of_[activity.id] = i;
    ids_.push_back(activity.id);
    const bool waits_for_others = activity.lateness == temporal::LatenessPolicy::push;
    const bool may_go = activity.may_skip || !activity.skip_if.empty() || open_choices.contains(activity.id);
    if (waits_for_others || may_go) continue;
    for (ConditionNode& node : conjuncts(activity.pre)) {
      if (!asks_for_a_state(node) || foreseen.contains(node.timeline)) continue;
      touched_by_[i].push_back(node.timeline);
      timelines_[node.timeline].consumers.push_back({i, std::move(node)});
    }
  }
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    for (const temporal::Impact& impact : plan.activities[i].impacts) {
      const auto timeline = timelines_.find(impact.timeline);
      if (timeline == timelines_.end() || impact.kind != temporal::ImpactKind::assign) continue;
      timeline->second.producers.push_back({i, impact.amount});
      touched_by_[i].push_back(impact.timeline);
    }
  }
}

void ConflictMonitor::continue_from(const ConflictMonitor& before) {
  for (auto& [name, timeline] : timelines_) {
    const auto known = before.timelines_.find(name);
    if (known == before.timelines_.end() || timeline.consumers.empty()) continue;
    timeline.value = known->second.value;
    touched_.insert(name);
    if (known->second.conflict == nullptr) continue;
    timeline.since = known->second.since;
    timeline.conflict = timeline.consumers.data();  // update() finds the one that it is, if it still stands
  }
}

void ConflictMonitor::observe(const std::string& timeline, const Value& value) {
  const auto known = timelines_.find(timeline);
  if (known == timelines_.end()) return;
  known->second.value = value;
  touched_.insert(timeline);
}

void ConflictMonitor::change(const std::string& activity, ActivityState state) {
  const auto index = index_of_.find(activity);
  if (index == index_of_.end() || states_[index->second] == state) return;
  states_[index->second] = state;
  touched_.insert(touched_by_[index->second].begin(), touched_by_[index->second].end());
}

const ConflictMonitor::Consumer* ConflictMonitor::first_unmet(const Timeline& timeline) const {
  if (!timeline.value) return nullptr;
  for (const Consumer& consumer : timeline.consumers) {
    if (states_[consumer.activity] != ActivityState::waiting) continue;
    const Condition asked{{consumer.node}};
    if (temporal::evaluate(asked, only(*timeline.value)) != Truth::no) continue;
    const bool may_come =
        std::any_of(timeline.producers.begin(), timeline.producers.end(), [&](const Producer& producer) {
          return producer.activity != consumer.activity && !is_over(states_[producer.activity]) &&
                 temporal::evaluate(asked, only(producer.value)) == Truth::yes;
        });
    if (!may_come) return &consumer;
  }
  return nullptr;
}

void ConflictMonitor::update(Time now) {
  for (const std::string& name : touched_) {
    Timeline& timeline = timelines_.at(name);
    const Consumer* unmet = first_unmet(timeline);
    if (unmet != nullptr && timeline.conflict == nullptr) timeline.since = now;
    timeline.conflict = unmet;
  }
  touched_.clear();
}

std::optional<PredictedConflict> ConflictMonitor::conflict(Time now) {
  update(now);
  const Timeline* first = nullptr;
  for (const auto& [name, timeline] : timelines_) {
    if (timeline.conflict == nullptr || now < timeline.since + lasting_) continue;
    if (first == nullptr || timeline.conflict->activity < first->conflict->activity) first = &timeline;
  }
  if (first == nullptr) return std::nullopt;
  return PredictedConflict{ids_[first->conflict->activity],
                           temporal::explain(Condition{{first->conflict->node}}, only(*first->value))};
}

std::optional<Time> ConflictMonitor::next_check() const {
  std::optional<Time> out;
  for (const auto& [name, timeline] : timelines_)
    if (timeline.conflict != nullptr && (!out || timeline.since + lasting_ < *out))
      out = timeline.since + lasting_;
  return out;
}

}  // namespace roci::exec::reactor
