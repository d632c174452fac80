// This file lists the fields of plans and what they are made of, each type once, for writing and reading.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/plan_delta.hpp"
#include "exec_svc/archive/archive.hpp"

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
  if constexpr (A::writes) {
    a(v.scores());
  } else {
    std::vector<double> scores;
    a(scores);
    v = temporal::RankVector(std::move(scores));
  }
}
template <class A>
void fields(A& a, Of<temporal::PlanCommand, A>& v) {
  a(v.owner, v.robot, v.subsystem, v.command_name, v.arguments, v.answer_within);
}
template <class A>
void fields(A& a, Of<temporal::PlanActivity, A>& v) {
  a(v.id, v.name, v.level, v.parent, v.owner, v.robot, v.subsystem, v.command_name, v.arguments,
    v.answer_within);
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

}  // namespace roci::exec::archive
