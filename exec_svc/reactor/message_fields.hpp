// This file lists the fields of the reactor's messages for the archive, each type once, for writing and
// reading. A type that gains a member gains it here too: what is left out is lost at a restart.
#pragma once

#include "exec_svc/archive/plan_fields.hpp"
#include "exec_svc/executive/message_fields.hpp"
#include "exec_svc/goals/goal_fields.hpp"
#include "exec_svc/orders/order_fields.hpp"
#include "exec_svc/problem/problem_fields.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

template <class A>
void fields(A& a, archive::Of<PeerLoss, A>& v) {
  a(v.service, v.reason, v.observes);
}
template <class A>
void fields(A& a, archive::Of<ModelVersion, A>& v) {
  a(v.owner, v.version);
}
template <class A>
void fields(A& a, archive::Of<BlockingGoal, A>& v) {
  a(v.key, v.timeline, v.reason);
}
template <class A>
void fields(A& a, archive::Of<PlanReply, A>& v) {
  a(v.call, v.verdict, v.reason, v.blocking, v.plan);
}
template <class A>
void fields(A& a, archive::Of<GivenAnswer, A>& v) {
  a(v.key, v.sample, v.decision, v.choice, v.value);
}
template <class A>
void fields(A& a, archive::Of<DecisionRecord, A>& v) {
  a(v.status, v.plan_version);
}
template <class A>
void fields(A& a, archive::Of<AnswerReceipt, A>& v) {
  a(v.key, v.answers, v.decision, v.result);
}
template <class A>
void fields(A& a, archive::Of<ReactorInputs, A>& v) {
  a(v.restarted, v.epoch, v.goals, v.observations, v.acks, v.losses, v.arrivals, v.models, v.reply, v.deltas);
  a(v.answers, v.ground_orders, v.handed_over);
}
template <class A>
void fields(A& a, archive::Of<PlannedAction, A>& v) {
  a(v.activity, v.name, v.arguments, v.start, v.duration);
}
template <class A>
void fields(A& a, archive::Of<PlanRequest, A>& v) {
  a(v.id, v.problem_name, v.problem, v.origin, v.remaining);
}
template <class A>
void fields(A& a, archive::Of<PlanReceipt, A>& v) {
  a(v.version, v.refused, v.reason, v.conflict, v.open);
}
template <class A>
void fields(A& a, archive::Of<ReactorCounts, A>& v) {
  a(v.planner_calls, v.replans, v.achieved, v.dropped, v.failed, v.open);
}

}  // namespace roci::exec::reactor
