// The fields of what goes into a journal, each type once, for reading and writing. A type that gains a member
// gains it here too: what is left out is lost at a restart.
#pragma once

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::archive {

template <class A>
void fields(A& a, Of<temporal::State, A>& v) {
  a(v.name, v.arguments);
}
template <class A>
void fields(A& a, Of<temporal::Property, A>& v) {
  a(v.name, v.value);
}
template <class A>
void fields(A& a, Of<temporal::ConditionNode, A>& v) {
  a(v.op, v.child_count, v.timeline, v.operand);
}
template <class A>
void fields(A& a, Of<temporal::Condition, A>& v) {
  a(v.nodes);
}
template <class A>
void fields(A& a, Of<temporal::Impact, A>& v) {
  a(v.timeline, v.kind, v.moment, v.amount);
}
template <class A>
void fields(A& a, Of<temporal::TemporalConstraint, A>& v) {
  a(v.from_point, v.to_point, v.kind, v.lower, v.upper);
}
template <class A>
void fields(A& a, Of<temporal::RankVector, A>& v) {
  std::vector<double> scores = v.scores();
  a(scores);
  if constexpr (!A::writes) v = temporal::RankVector(std::move(scores));
}
template <class A>
void fields(A& a, Of<temporal::PlanCommand, A>& v) {
  a(v.owner, v.robot, v.subsystem, v.command_name, v.arguments, v.answer_within);
}
template <class A>
void fields(A& a, Of<temporal::PlanActivity, A>& v) {
  a(v.id, v.name, v.level, v.parent, v.owner, v.robot, v.subsystem, v.command_name, v.arguments, v.answer_within);
  a(v.then, v.start_point, v.end_point, v.duration_lower, v.duration_upper, v.preferred_start);
  a(v.pre, v.maintenance, v.post, v.impacts, v.wait_timeout, v.retries, v.may_skip, v.skip_if, v.lateness);
  a(v.commit, v.failure, v.contingency, v.priority, v.goals_served, v.utility);
}
template <class A>
void fields(A& a, Of<temporal::Token, A>& v) {
  a(v.timeline, v.held, v.start_point, v.end_point);
}
template <class A>
void fields(A& a, Of<temporal::DecisionChoice, A>& v) {
  a(v.name, v.activities, v.rule);
}
template <class A>
void fields(A& a, Of<temporal::ArgumentBinding, A>& v) {
  a(v.activity, v.argument);
}
template <class A>
void fields(A& a, Of<temporal::DecisionPoint, A>& v) {
  a(v.id, v.resolver, v.choices, v.decide_before, v.resolver_kind, v.bindings, v.admissible);
}
template <class A>
void fields(A& a, Of<temporal::FunctionValueUse, A>& v) {
  a(v.function, v.arguments, v.number, v.owner, v.model_version, v.computed, v.accuracy);
}
template <class A>
void fields(A& a, Of<temporal::FlexiblePlan, A>& v) {
  a(v.id, v.version, v.engine, v.origin, v.point_count);
  a(v.activities, v.tokens, v.decisions, v.constraints, v.function_values);
}

template <class A>
void fields(A& a, Of<temporal::PlanDelta, A>& v) {
  a(v.from_version, v.added, v.removed_activities, v.removed_decisions, v.removed_tokens,
    v.removed_constraints);
}

template <class A>
void fields(A& a, Of<goals::GoalKey, A>& v) {
  a(v.issuer, v.id);
}
template <class A>
void fields(A& a, Of<goals::SampleId, A>& v) {
  a(v.sender, v.incarnation, v.number);
}
template <class A>
void fields(A& a, Of<goals::GoalRequest, A>& v) {
  a(v.key, v.kind, v.arguments, v.importance, v.utility, v.priority, v.opens, v.closes, v.recalled, v.sample);
}
template <class A>
void fields(A& a, Of<goals::GoalRecord, A>& v) {
  a(v.request, v.state, v.reason, v.arrival, v.plan_version, v.answers);
}
template <class A>
void fields(A& a, Of<executive::Observation, A>& v) {
  a(v.timeline, v.value);
}
template <class A>
void fields(A& a, Of<executive::CommandAck, A>& v) {
  a(v.activity, v.attempt, v.stage, v.code, v.reason);
}
template <class A>
void fields(A& a, Of<reactor::PeerLoss, A>& v) {
  a(v.service, v.reason);
}
template <class A>
void fields(A& a, Of<reactor::ModelVersion, A>& v) {
  a(v.owner, v.version);
}
template <class A>
void fields(A& a, Of<reactor::PlanReply, A>& v) {
  a(v.call, v.verdict, v.reason, v.plan);
}
template <class A>
void fields(A& a, Of<reactor::ReactorInputs, A>& v) {
  a(v.restarted, v.goals, v.observations, v.acks, v.losses, v.arrivals, v.models, v.reply, v.deltas);
}
template <class A>
void fields(A& a, Of<problem::ProblemObject, A>& v) {
  a(v.name, v.type, v.properties);
}
template <class A>
void fields(A& a, Of<problem::Problem, A>& v) {
  a(v.text, v.objects);
}
template <class A>
void fields(A& a, Of<reactor::PlannedAction, A>& v) {
  a(v.activity, v.name, v.arguments, v.start, v.duration);
}
template <class A>
void fields(A& a, Of<reactor::PlanRequest, A>& v) {
  a(v.id, v.problem_name, v.problem, v.origin, v.remaining);
}
template <class A>
void fields(A& a, Of<reactor::PlanReceipt, A>& v) {
  a(v.version, v.refused, v.reason, v.open);
}
template <class A>
void fields(A& a, Of<reactor::ReactorCounts, A>& v) {
  a(v.planner_calls, v.replans, v.achieved, v.dropped, v.failed, v.open);
}

template <class T>
std::string to_bytes(const T& value) {
  Writer writer;
  writer(value);
  return writer.take();
}

// Throws ArchiveError.
template <class T>
T from_bytes(std::string_view bytes) {
  T out{};
  Reader reader(bytes);
  reader(out);
  reader.finish();
  return out;
}

}  // namespace roci::exec::archive
