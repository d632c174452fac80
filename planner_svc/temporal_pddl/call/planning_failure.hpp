// How a planning call ends early, wherever it is: with a verdict and a reason.
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "core/temporal/verdict.hpp"

namespace roci::planner::temporal_pddl::call {

/// Is thrown inside the engine only; plan() turns it into a Result.
class PlanningFailure : public std::exception {
 public:
  PlanningFailure(temporal::Verdict verdict, std::string reason)
      : verdict_(verdict), reason_(std::move(reason)) {}

  const char* what() const noexcept override { return reason_.c_str(); }
  temporal::Verdict verdict() const { return verdict_; }
  const std::string& reason() const { return reason_; }

 private:
  temporal::Verdict verdict_;
  std::string reason_;
};

}  // namespace roci::planner::temporal_pddl::call
