#include "exec_svc/executive/decision_points.hpp"

#include <algorithm>
#include <utility>

namespace roci::exec::executive {

using temporal::ArgumentBinding;
using temporal::bounded;
using temporal::DecisionChoice;
using temporal::DecisionPoint;
using temporal::ResolverKind;
using temporal::Time;
using temporal::TimePoint;

namespace {

constexpr char kRule[] = "rule";

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
  return out;
}

std::vector<std::string> names_of(const std::vector<DecisionChoice>& choices) {
  std::vector<std::string> out;
  for (const DecisionChoice& choice : choices) out.push_back(choice.name);
  return out;
}

/// Returns whether both are the same question, wherever its time point stands in the network.
bool same_question(DecisionPoint a, const DecisionPoint& b) {
  a.decide_before = b.decide_before;
  return a == b;
}

}  // namespace

DecisionPoints::DecisionPoints(RunState& state, StartWaits& waits)
    : state_(&state), waits_(&waits), records_(state.plan.decisions.size()) {
  for (std::size_t d = 0; d < state.plan.decisions.size(); ++d) {
    open_.insert(d);
    hold(d);
  }
}

void DecisionPoints::hold(std::size_t index) {
  const DecisionPoint& decision = state_->plan.decisions[index];
  const auto start_of = [this](const std::string& activity) {
    return state_->plan.activities[state_->index_of.at(activity)].start_point;
  };
  std::set<TimePoint> held;
  for (const DecisionChoice& choice : decision.choices)
    for (const std::string& id : choice.activities) held.insert(start_of(id));
  for (const ArgumentBinding& binding : decision.bindings) held.insert(start_of(binding.activity));
  if (held.empty()) held.insert(decision.decide_before);
  Record& record = records_[index];
  record.due_by.assign(held.begin(), held.end());
  held.insert(decision.decide_before);
  for (const TimePoint point : record.due_by) {
    const auto& together = state_->points.precedence().together[point];
    held.insert(together.begin(), together.end());
  }
  record.held.assign(held.begin(), held.end());
  for (const TimePoint point : held) state_->points.hold(point);
}

AnswerResult DecisionPoints::take_answer(const DecisionAnswer& answer, Time now) {
  const auto& decisions = state_->plan.decisions;
  const auto asked = std::ranges::find(decisions, answer.decision, &DecisionPoint::id);
  if (asked == decisions.end())
    return {AnswerOutcome::unknown_decision, "the running plan has no decision " + answer.decision};
  const auto index = static_cast<std::size_t>(asked - decisions.begin());
  AnswerResult result = fault_of(index, answer, now);
  if (result.outcome == AnswerOutcome::taken) {
    settle(index, asked->choices.empty() ? answer.value : answer.choice, answer.issuer, now);
    tell(index);
  }
  return result;
}

/// Returns `taken` if nothing is wrong with the answer.
AnswerResult DecisionPoints::fault_of(std::size_t index, const DecisionAnswer& answer, Time now) const {
  const DecisionPoint& decision = state_->plan.decisions[index];
  const Record& record = records_[index];
  if (decision.resolver_kind == ResolverKind::rule)
    return {AnswerOutcome::not_entitled, "the conditions of its choices decide"};
  if (record.state == DecisionState::answered)
    return {AnswerOutcome::repeated, "it was answered with " + record.chosen + " before"};
  if (!record.asked_at)
    return {AnswerOutcome::unknown_decision, "nobody has asked for " + decision.id + " yet"};
  if (record.state != DecisionState::open || !state_->starting())
    return {AnswerOutcome::late, "the plan no longer asks for " + decision.id};
  if (now > answer_before(index))
    return {AnswerOutcome::late, "it was due before " + temporal::to_text(answer_before(index))};
  const std::vector<std::string> choices = names_of(decision.choices);
  if (!choices.empty() && std::ranges::find(choices, answer.choice) == choices.end())
    return {AnswerOutcome::unknown_choice,
            "there is no choice '" + answer.choice + "'; one of: " + listed(choices)};
  const auto& admissible = decision.admissible;
  if (choices.empty() && !admissible.empty() &&
      std::ranges::find(admissible, answer.value) == admissible.end())
    return {AnswerOutcome::unknown_choice,
            "the value '" + answer.value + "' may not be bound; one of: " + listed(admissible)};
  return {};
}

void DecisionPoints::settle(std::size_t index, const std::string& chosen, const std::string& by, Time now) {
  const DecisionPoint& decision = state_->plan.decisions[index];
  Record& record = records_[index];
  open_.erase(index);
  record.state = DecisionState::answered;
  record.chosen = chosen;
  record.answered_by = by;
  skip_others(decision, chosen);
  for (const ArgumentBinding& binding : decision.bindings)
    state_->bound[state_->index_of.at(binding.activity)].push_back({binding.argument, chosen});
  for (const TimePoint point : record.held) {
    state_->points.release(point);
    const PointOwner& owner = state_->points.owner(point);
    if (owner.role == PointRole::start) waits_->consider(owner.activity, now);
  }
}

void DecisionPoints::skip_others(const DecisionPoint& decision, const std::string& chosen) {
  std::set<std::string> wanted, unwanted;
  for (const DecisionChoice& choice : decision.choices)
    (choice.name == chosen ? wanted : unwanted).insert(choice.activities.begin(), choice.activities.end());
  for (const std::string& id : unwanted) {
    const Index activity = state_->index_of.at(id);
    if (!wanted.contains(id) && state_->runs[activity].phase == ActivityPhase::waiting)
      state_->skip(activity, "decision " + decision.id + ": " + chosen);
  }
}

bool DecisionPoints::ask(Time now) {
  bool progress = false;
  const std::set<std::size_t> open = open_;
  for (const std::size_t d : open) {
    if (!state_->starting()) break;
    const DecisionPoint& decision = state_->plan.decisions[d];
    Record& record = records_[d];
    const auto due = [this](TimePoint point) { return state_->points.only_held(point); };
    if (!record.asked_at) {
      if (std::ranges::none_of(record.due_by, due)) continue;
      record.asked_at = now;
      progress = true;
      if (resolve_by_rule(d, now)) continue;
      tell(d);
    } else if (resolve_by_rule(d, now)) {
      progress = true;
    } else if (now > answer_before(d) || state_->points.happened_at(decision.decide_before)) {
      record.state = DecisionState::missed;
      tell(d);
      open_.erase(d);
      state_->break_plan(Breakage::decision_missing, decision.id,
                         decision.resolver_kind == ResolverKind::rule
                             ? "no rule of it held in time"
                             : "no answer from " + resolver_of(decision) + " in time",
                         "");
    }
  }
  return progress;
}

/// Takes the first choice whose condition holds now; a choice without one always holds.
bool DecisionPoints::resolve_by_rule(std::size_t index, Time now) {
  const DecisionPoint& decision = state_->plan.decisions[index];
  if (decision.resolver_kind != ResolverKind::rule || now > answer_before(index)) return false;
  const auto chosen = std::ranges::find_if(decision.choices, [this](const DecisionChoice& choice) {
    return choice.rule.empty() || evaluate(choice.rule, state_->lookup()) == temporal::Truth::yes;
  });
  if (chosen == decision.choices.end()) return false;
  settle(index, chosen->name, kRule, now);
  tell(index);
  return true;
}

void DecisionPoints::close() {
  if (state_->starting()) return;
  for (const std::size_t d : std::exchange(open_, {})) {
    records_[d].state = DecisionState::void_;
    if (records_[d].asked_at) tell(d);
  }
}

void DecisionPoints::inherit(const DecisionPoints& before, Time now) {
  const auto& decisions = state_->plan.decisions;
  for (std::size_t old = 0; old < before.records_.size(); ++old) {
    const DecisionPoint& asked = before.state_->plan.decisions[old];
    const Record& record = before.records_[old];
    if (!record.asked_at) continue;
    const auto found = std::ranges::find_if(
        decisions, [&](const DecisionPoint& decision) { return same_question(decision, asked); });
    const bool stands = found != decisions.end();
    const auto index = static_cast<std::size_t>(found - decisions.begin());
    if (record.state == DecisionState::answered && stands) {
      records_[index].asked_at = record.asked_at;
      settle(index, record.chosen, record.answered_by, now);
    } else if (record.state == DecisionState::open && stands) {
      records_[index].asked_at = record.asked_at;
    } else if (record.state == DecisionState::open) {
      state_->outputs.decisions.push_back({asked.id, before.resolver_of(asked), names_of(asked.choices),
                                           asked.admissible, temporal::no_bound, DecisionState::void_});
    }
  }
}

void DecisionPoints::tell(std::size_t index) {
  const DecisionPoint& decision = state_->plan.decisions[index];
  const Record& record = records_[index];
  state_->outputs.decisions.push_back({decision.id, resolver_of(decision), names_of(decision.choices),
                                       decision.admissible, answer_before(index), record.state, record.chosen,
                                       record.answered_by});
}

std::string DecisionPoints::resolver_of(const DecisionPoint& decision) const {
  if (!decision.resolver.empty()) return decision.resolver;
  switch (decision.resolver_kind) {
    case ResolverKind::engine:
      return state_->plan.engine.empty() ? "engine" : state_->plan.engine;
    case ResolverKind::ground:
      return "ground";
    case ResolverKind::rule:
      return kRule;
  }
  return "";
}

Time DecisionPoints::next_timer(Time now) const {
  Time next = temporal::no_bound;
  for (const std::size_t d : open_) {
    if (!records_[d].asked_at) continue;
    const Time missing = answer_before(d) + temporal::Duration{1};
    if (missing > now) next = std::min(next, missing);
  }
  return next;
}

Time DecisionPoints::answer_before(std::size_t index) const {
  const Time latest = state_->points.window(state_->plan.decisions[index].decide_before).upper;
  if (bounded(latest)) return latest;
  return temporal::plus(records_[index].asked_at.value_or(Time{0}), state_->settings.decision_timeout);
}

}  // namespace roci::exec::executive
