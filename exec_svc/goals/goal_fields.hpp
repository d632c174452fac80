// This file lists the fields of goals for the archive, each type once, for writing and reading.
#pragma once

#include "exec_svc/archive/plan_fields.hpp"
#include "exec_svc/goals/goal_set.hpp"

namespace roci::exec::goals {

template <class A>
void fields(A& a, archive::Of<GoalKey, A>& v) {
  a(v.issuer, v.id);
}
template <class A>
void fields(A& a, archive::Of<SampleId, A>& v) {
  a(v.sender, v.incarnation, v.number);
}
template <class A>
void fields(A& a, archive::Of<GoalRequest, A>& v) {
  a(v.key, v.robot, v.kind, v.arguments, v.importance, v.utility, v.priority, v.preferred, v.opens, v.closes);
  a(v.recalled, v.sample);
}
template <class A>
void fields(A& a, archive::Of<GoalRecord, A>& v) {
  a(v.request, v.state, v.reason, v.arrival, v.plan_version, v.answers, v.revision, v.before);
}

}  // namespace roci::exec::goals
