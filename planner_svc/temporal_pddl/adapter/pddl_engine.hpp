// The temporal PDDL engine behind the seam of planner_svc: PDDL texts and a budget in, a verdict and a plan
// out.
#pragma once

#include "planner_svc/engine/answering_engine.hpp"

namespace roci::planner::temporal_pddl::adapter {

/// Reads Request::model as the domain, problem_text as the problem and `remaining` as the plan to begin with;
/// values of timelines and conditions of goals stand in the problem. Never throws. The record of a call is
/// N.pddl, the problem; N.values, the function values that it was given; N.remaining, what remained of an
/// earlier plan, if anything. roci-plan makes the call of them again (R41).
class PddlEngine final : public engine::AnsweringEngine {
 public:
  engine::Answer answer(const engine::Request& request, const engine::Limits& limits,
                        engine::FunctionSource& functions) override;
};

}  // namespace roci::planner::temporal_pddl::adapter
