// Decision resolvers answer at run time the decisions that an engine's plan has left open (R131).
#pragma once

#include <optional>
#include <stop_token>
#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// Refers to a decision that the executive of a running plan asks for.
struct OpenDecision {
  const Request& request;  ///< engine, robot, model; `origin` is now, `state` what is observed now; no goals
  const temporal::FlexiblePlan& plan;  ///< that is executed
  const temporal::DecisionPoint& decision;
  temporal::Time answer_before = temporal::no_bound;  ///< mission time
  std::stop_token stop{};                             ///< once it is requested nobody waits for an answer
};

/// Holds the answer: one of the choices, or the value for the arguments that the decision binds.
struct Resolution {
  std::string choice{};
  std::string value{};
  friend bool operator==(const Resolution&, const Resolution&) = default;
};

/// Serves as the base of resolvers.
class DecisionResolver {
 public:
  virtual ~DecisionResolver() = default;

  /// Decides on what is known now; the result depends on `open` alone. It returns nothing if the information is not
  /// there yet, and is then asked again when something else is observed, as long as the decision is open. What it
  /// throws is reported, and nothing is answered. It returns soon after a stop is requested, with whatever it has.
  virtual std::optional<Resolution> resolve(const OpenDecision& open) const = 0;
};

}  // namespace roci::planner::engine
