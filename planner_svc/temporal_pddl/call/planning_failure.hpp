// How a planning call ends early, wherever it is: with a verdict and a reason.
#pragma once

#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/verdict.hpp"
#include "planner_svc/temporal_pddl/call/named_goal.hpp"

namespace roci::planner::temporal_pddl::call {

/// Carries a failure out of the engine's parts; plan() turns it into a Result.
class PlanningFailure : public std::exception {
 public:
  PlanningFailure(temporal::Verdict verdict, std::string reason, std::vector<BlockedFact> blocked = {})
      : verdict_(verdict), reason_(std::move(reason)), blocked_(std::move(blocked)) {}

  const char* what() const noexcept override { return reason_.c_str(); }
  temporal::Verdict verdict() const { return verdict_; }
  const std::string& reason() const { return reason_; }
  /// The facts of the goal that are known to be out of reach.
  const std::vector<BlockedFact>& blocked() const { return blocked_; }

 private:
  temporal::Verdict verdict_;
  std::string reason_;
  std::vector<BlockedFact> blocked_;
};

}  // namespace roci::planner::temporal_pddl::call
