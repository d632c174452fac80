// The steps of a plan are looked up in the domain and put in order of time.
#pragma once

#include <vector>

#include "planner_svc/temporal_pddl/validate/model.hpp"
#include "planner_svc/temporal_pddl/validate/report.hpp"

namespace roci::planner::temporal_pddl::validate {

/// Has exactly one of the two actions set, or none if the step names no action that can be executed.
struct Step {
  const pddl::Action* instantaneous = nullptr;
  const pddl::DurativeAction* durative = nullptr;
  Bindings bindings;

  bool executable() const { return instantaneous || durative; }
};

/// Returns one entry per step of the plan, in its order; each step that cannot be executed adds a violation.
/// `plan` must outlive the result.
std::vector<Step> resolve(const std::vector<pddl::PlanStep>& plan, const Model& model,
                          std::vector<Violation>& violations);

/// Lists the kinds in the order in which events of one moment are executed.
enum class EventKind { timed_literal, timed_value, instant, start, end };

/// Describes one happening of the plan or of the problem; events compare in their order of execution.
struct Event {
  pddl::Microseconds time{0};
  EventKind kind = EventKind::instant;
  std::size_t index = 0;  ///< numbers the step, the timed literal or the timed value

  auto operator<=>(const Event&) const = default;
};

/// Returns all events of the executable steps, and those of the timed facts until the last of them, in order
/// of time.
std::vector<Event> schedule(const std::vector<pddl::PlanStep>& plan, const std::vector<Step>& steps,
                            const pddl::Problem& problem);

}  // namespace roci::planner::temporal_pddl::validate
