// A checker is the independent check that every plan of an engine passes before it leaves the planner.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/projection.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// Refers to a plan and all that it must fit.
struct CheckedPlan {
  const Request& request;
  /// Holds the values as the owners gave them in this call; a plan may rest on exact ones alone.
  std::span<const FunctionUse> values;
  const temporal::FlexiblePlan& plan;
  const temporal::FlexiblePlan* before = nullptr;  ///< the version that it changes; null: there is none
  /// Says how far the executed version has come; null: none is executed.
  const temporal::Progress* progress = nullptr;
  std::filesystem::path model_file{};  ///< of the request's model, for what it includes
};

/// Checks plans, and shares no more with its engine than the reader of the model, so that a fault of the
/// engine cannot hide itself.
class Checker {
 public:
  virtual ~Checker() = default;

  /// Returns everything that is wrong with the plan as an answer to the request, one plain sentence each;
  /// with none it may be sent. If it throws, the plan is not sent either.
  virtual std::vector<std::string> faults(const CheckedPlan& checked) const = 0;
};

}  // namespace roci::planner::engine
