#include "planner_svc/temporal_pddl/validate/steps.hpp"

#include <algorithm>
#include <cmath>

#include "core/pddl/printer.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

template <typename T>
const T* find_by_name(const std::vector<T>& actions, const std::string& name) {
  const auto it =
      std::find_if(actions.begin(), actions.end(), [&](const T& action) { return action.name == name; });
  return it == actions.end() ? nullptr : &*it;
}

// Returns what is wrong with the arguments; an empty text says that nothing is.
std::string bind_arguments(const pddl::Atom& action, const std::vector<pddl::TypedName>& parameters,
                           const pddl::ObjectTable& objects, Bindings& bindings) {
  if (action.arguments.size() != parameters.size()) {
    return std::to_string(action.arguments.size()) + " arguments, the action has " +
           std::to_string(parameters.size()) + " parameters";
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& name = action.arguments[i].name;
    const int object = objects.find(name);
    if (object < 0) return "unknown object '" + name + "'";
    if (!objects.has_type(static_cast<std::size_t>(object), parameters[i].types)) {
      return "object '" + name + "' is not of the type of " + parameters[i].name;
    }
    bindings.push(parameters[i].name, name);
  }
  return "";
}

std::string check_times(const pddl::PlanStep& step, bool durative) {
  if (step.start < pddl::Microseconds(0)) return "starts before 0";
  if (durative && !step.duration) return "a durative action without a duration";
  if (durative && *step.duration < pddl::Microseconds(0)) return "a negative duration";
  if (!durative && step.duration && *step.duration != pddl::Microseconds(0)) {
    return "an instantaneous action with a duration";
  }
  return "";
}

}  // namespace

std::vector<Step> resolve(const std::vector<pddl::PlanStep>& plan, const Model& model,
                          std::vector<Violation>& violations) {
  std::vector<Step> steps(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const pddl::PlanStep& from = plan[i];
    const auto report = [&](ViolationKind kind, const std::string& message) {
      violations.push_back({kind, i, from.start, pddl::print(from.action), "", message});
      steps[i] = {};
    };
    Step& step = steps[i];
    step.durative = find_by_name(model.domain().durative_actions, from.action.symbol);
    step.instantaneous = find_by_name(model.domain().actions, from.action.symbol);
    if (!step.executable()) {
      report(ViolationKind::unknown_action, "the domain has no action '" + from.action.symbol + "'");
      continue;
    }
    const auto& parameters = step.durative ? step.durative->parameters : step.instantaneous->parameters;
    if (const auto wrong = bind_arguments(from.action, parameters, model.objects(), step.bindings);
        !wrong.empty()) {
      report(ViolationKind::wrong_arguments, wrong);
    } else if (const auto late = check_times(from, step.durative != nullptr); !late.empty()) {
      report(ViolationKind::time, late);
    }
  }
  return steps;
}

std::vector<Event> schedule(const std::vector<pddl::PlanStep>& plan, const std::vector<Step>& steps,
                            const pddl::Problem& problem) {
  std::vector<Event> events;
  pddl::Microseconds last{0};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].instantaneous) {
      events.push_back({plan[i].start, EventKind::instant, i});
      last = std::max(last, plan[i].start);
    } else if (steps[i].durative) {
      const pddl::Microseconds end = plan[i].start + *plan[i].duration;
      events.push_back({plan[i].start, EventKind::start, i});
      events.push_back({end, EventKind::end, i});
      last = std::max(last, end);
    }
  }
  const auto add_timed = [&](double seconds, EventKind kind, std::size_t index) {
    if (seconds * 1e6 >= static_cast<double>(last.count()) + 0.5) return;
    events.push_back({pddl::Microseconds(std::llround(seconds * 1e6)), kind, index});
  };
  for (std::size_t i = 0; i < problem.timed_literals.size(); ++i) {
    if (problem.timed_literals[i].time > 0)  // else it is part of the initial state
      add_timed(problem.timed_literals[i].time, EventKind::timed_literal, i);
  }
  for (std::size_t i = 0; i < problem.timed_values.size(); ++i) {
    add_timed(problem.timed_values[i].time, EventKind::timed_value, i);
  }
  std::sort(events.begin(), events.end());
  return events;
}

}  // namespace roci::planner::temporal_pddl::validate
