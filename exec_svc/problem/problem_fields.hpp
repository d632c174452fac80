// This file lists the fields of problems for the archive, each type once, for writing and reading.
#pragma once

#include "exec_svc/archive/plan_fields.hpp"
#include "exec_svc/goals/goal_fields.hpp"
#include "exec_svc/problem/problem.hpp"

namespace roci::exec::problem {

template <class A>
void fields(A& a, archive::Of<ProblemObject, A>& v) {
  a(v.name, v.type, v.properties);
}
template <class A>
void fields(A& a, archive::Of<PredictedValue, A>& v) {
  a(v.timeline, v.at, v.value);
}
template <class A>
void fields(A& a, archive::Of<ProblemGoal, A>& v) {
  a(v.key, v.achieved, v.importance, v.utility, v.priority, v.preferred, v.opens, v.closes);
}
template <class A>
void fields(A& a, archive::Of<Problem, A>& v) {
  a(v.text, v.state, v.predictions, v.goals, v.objects);
}

}  // namespace roci::exec::problem
