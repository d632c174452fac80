// This resolver answers the decisions that plans of this engine leave to it (R131).
#pragma once

#include "planner_svc/engine/decision_resolver.hpp"

namespace roci::planner::timeline_htn::adapter {

/// Takes the first choice, or the first admissible value, that can be carried out from where the components are seen:
/// the one that was planned on first. It can if the search finds a way to its subgoals, one after the other as the
/// behaviour orders them, with no commands but those of the plan. What is not known yet leaves the decision open: a
/// component that the choices stand on is seen in no state of its own, or still in one that does not rest. Where
/// nothing can be carried out it stays open, too, until something else is seen,
/// or its time is over and the executive says so.
class TimelineResolver final : public engine::DecisionResolver {
 public:
  /// Throws std::runtime_error where the model of the request cannot be read, or has no such decision.
  std::optional<engine::Resolution> resolve(const engine::OpenDecision& open) const override;
};

}  // namespace roci::planner::timeline_htn::adapter
