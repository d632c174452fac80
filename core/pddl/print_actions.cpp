#include "core/pddl/overloaded.hpp"
#include "core/pddl/print_parts.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

std::string print(AssignmentOperator op) {
  switch (op) {
    case AssignmentOperator::assign:
      return "assign";
    case AssignmentOperator::increase:
      return "increase";
    case AssignmentOperator::decrease:
      return "decrease";
    case AssignmentOperator::scale_up:
      return "scale-up";
    case AssignmentOperator::scale_down:
      break;
  }
  return "scale-down";
}

std::string print_assignment(const Assignment& assignment) {
  return "(" + print(assignment.op) + " " + pddl::print(assignment.fluent) + " " +
         pddl::print(assignment.value) + ")";
}

bool is_true(const Condition& condition) {
  const And* all = std::get_if<And>(&condition.node);
  return all && all->parts.empty();
}

// Appends `(TIME part)` for each part of the conjunction.
void add_timed(std::string_view time, const Condition& condition, std::string& text) {
  const auto add = [&](const Condition& part) {
    text += " (" + std::string(time) + " " + pddl::print(part) + ")";
  };
  const And* all = std::get_if<And>(&condition.node);
  if (!all || all->parts.size() == 1) return add(condition);
  for (const Condition& part : all->parts) add(part);
}

std::string print_timed(const TimedCondition& condition) {
  std::string text = "(and";
  add_timed("at start", condition.at_start, text);
  add_timed("over all", condition.over_all, text);
  add_timed("at end", condition.at_end, text);
  return text + ")";
}

// Says when effects happen: in a plain action, or at a time of a durative one.
enum class Moment { plain, start, end, continuous };

std::string at_moment(Moment moment, std::string effect) {
  if (moment == Moment::start) return "(at start " + effect + ")";
  if (moment == Moment::end) return "(at end " + effect + ")";
  return effect;
}

std::string print_effects(const std::vector<Effect>& effects, Moment moment);

std::string print_effect(const Effect& effect, Moment moment) {
  return std::visit(
      Overloaded{
          [&](const Literal& literal) { return at_moment(moment, pddl::print(literal)); },
          [&](const Assignment& assignment) { return at_moment(moment, print_assignment(assignment)); },
          [&](const When& when) {
            const std::string condition =
                moment == Moment::plain ? pddl::print(when.condition.at_start) : print_timed(when.condition);
            return "(when " + condition + " " + print_effects(when.effects, moment) + ")";
          },
          [&](const ForallEffect& forall) {
            return "(forall (" + print_typed_names(forall.variables) + ") " +
                   print_effects(forall.effects, moment) + ")";
          }},
      effect.node);
}

std::string print_effects(const std::vector<Effect>& effects, Moment moment) {
  if (effects.size() == 1) return print_effect(effects.front(), moment);
  std::string text = "(and";
  for (const Effect& effect : effects) text += " " + print_effect(effect, moment);
  return text + ")";
}

std::string print_duration(const std::vector<DurationConstraint>& constraints) {
  std::string text = "(and";
  for (const DurationConstraint& constraint : constraints) {
    std::string one = "(" + pddl::print(constraint.op) + " ?duration " + pddl::print(constraint.bound) + ")";
    if (constraints.size() == 1 && constraint.at == TimePoint::start) return one;
    text += " " + (constraint.at == TimePoint::start ? one : "(at end " + one + ")");
  }
  return text + ")";
}

std::string print_head(std::string_view keyword, const std::string& name,
                       const std::vector<TypedName>& parameters) {
  return "  (" + std::string(keyword) + " " + name + "\n    :parameters (" + print_typed_names(parameters) +
         ")\n";
}

}  // namespace

std::string print_action(const Action& action) {
  std::string text = print_head(":action", action.name, action.parameters);
  if (!is_true(action.precondition)) text += "    :precondition " + pddl::print(action.precondition) + "\n";
  return text + "    :effect " + print_effects(action.effects, Moment::plain) + ")\n";
}

std::string print_action(const DurativeAction& action) {
  std::string text = print_head(":durative-action", action.name, action.parameters);
  text += "    :duration " + print_duration(action.duration) + "\n";
  text += "    :condition " + print_timed(action.condition) + "\n    :effect (and";
  for (const Effect& effect : action.start_effects) text += "\n      " + print_effect(effect, Moment::start);
  for (const Effect& effect : action.end_effects) text += "\n      " + print_effect(effect, Moment::end);
  for (const Effect& effect : action.continuous_effects) {
    text += "\n      " + print_effect(effect, Moment::continuous);
  }
  return text + "))\n";
}

}  // namespace roci::pddl
