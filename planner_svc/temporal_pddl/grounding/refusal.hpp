// How grounding ends early: with a verdict and, where a line of the model is to blame, its place.
#pragma once

#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "core/pddl/source.hpp"
#include "planner_svc/temporal_pddl/plan/result.hpp"

namespace roci::planner::temporal_pddl {

// Thrown inside the engine only; plan() turns it into a Result.
class Refusal : public std::exception {
 public:
  Refusal(Verdict verdict, std::string reason) : verdict_(verdict), reason_(std::move(reason)) {}
  Refusal(Verdict verdict, pddl::Diagnostic where)
      : verdict_(verdict), reason_(pddl::to_string(where)), where_(std::move(where)) {}

  const char* what() const noexcept override { return reason_.c_str(); }
  Verdict verdict() const { return verdict_; }
  const std::string& reason() const { return reason_; }
  const std::optional<pddl::Diagnostic>& where() const { return where_; }

 private:
  Verdict verdict_;
  std::string reason_;
  std::optional<pddl::Diagnostic> where_;
};

}  // namespace roci::planner::temporal_pddl
