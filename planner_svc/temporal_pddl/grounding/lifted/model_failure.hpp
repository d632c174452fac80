// A model failure is how grounding ends where a line of the model is to blame.
#pragma once

#include <utility>

#include "core/pddl/source.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"

namespace roci::planner::temporal_pddl::grounding::lifted {

/// Carries a planning failure that knows its place in the model; its reason is the diagnostic's text.
class ModelFailure final : public call::PlanningFailure {
 public:
  ModelFailure(temporal::Verdict verdict, pddl::Diagnostic where)
      : call::PlanningFailure(verdict, pddl::to_string(where)), where_(std::move(where)) {}

  const pddl::Diagnostic& where() const { return where_; }

 private:
  pddl::Diagnostic where_;
};

}  // namespace roci::planner::temporal_pddl::grounding::lifted
