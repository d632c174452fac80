#include "planner_svc/temporal_pddl/values/action_tuples.hpp"

#include <algorithm>
#include <functional>

#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"

namespace roci::planner::temporal_pddl::values {

using engine::FunctionCall;
using grounding::lifted::Binding, grounding::lifted::LiftedAction, grounding::lifted::LiftedEffect,
    grounding::lifted::LiftedExpression, grounding::lifted::LiftedFormula, grounding::lifted::Symbols,
    grounding::lifted::for_each_value, grounding::lifted::lower_actions, grounding::lifted::lower_goal,
    grounding::lifted::lower_metric, grounding::lifted::resolve;

namespace {

// Walks through what is read, with the quantified variables bound to each of their values.
class Reader {
 public:
  using Visit = std::function<void(const LiftedExpression&, const Binding&)>;

  // `visit` hears of every application of an external function.
  Reader(const Symbols& symbols, Binding& binding, const Visit& visit)
      : symbols_(symbols), binding_(binding), visit_(visit) {}

  void read(const LiftedExpression& expression) {
    if (expression.kind == LiftedExpression::Kind::function && !symbols_[expression.function].module.empty())
      visit_(expression, binding_);
    for (const LiftedExpression& operand : expression.operands) read(operand);
  }

  void read(const LiftedFormula& formula) {
    for_each_value(formula.quantified, binding_, [&] {
      for (const LiftedFormula& part : formula.parts) read(part);
      for (const LiftedExpression& side : formula.sides) read(side);
    });
  }

  void read(const LiftedEffect& effect) {
    for_each_value(effect.quantified, binding_, [&] {
      read(effect.start_condition);
      read(effect.end_condition);
      if (effect.kind == LiftedEffect::Kind::numeric) read(effect.value);
    });
  }

  void read(const LiftedAction& action) {
    for (const auto& rule : action.duration) read(rule.bound);
    for (const auto* formula : {&action.at_start, &action.over_all, &action.at_end}) read(*formula);
    for (const auto* effects : {&action.start_effects, &action.end_effects})
      for (const LiftedEffect& effect : *effects) read(effect);
  }

 private:
  const Symbols& symbols_;
  Binding& binding_;
  const Visit& visit_;
};

}  // namespace

ActionTuples::ActionTuples(const pddl::Domain& domain, const pddl::Problem& problem)
    : symbols_(domain, problem), actions_(lower_actions(domain, symbols_)) {
  const Reader::Visit note = [&](const LiftedExpression& application, const Binding&) {
    read_by_all_.insert(symbols_[application.function].name);
  };
  std::uint32_t slots = 0;
  const LiftedFormula goal = lower_goal(problem.goal, problem.file, symbols_, slots);
  Binding binding(slots);
  Reader of_goal(symbols_, binding, note);
  of_goal.read(goal);
  if (problem.metric) of_goal.read(lower_metric(problem.metric->expression, problem.file, symbols_));
  for (const LiftedAction& action : actions_) {
    if (!action.layer) continue;
    Binding of_rule(action.slots);
    Reader(symbols_, of_rule, note).read(action);
  }
}

void ActionTuples::collect(const ActionInstance& instance, std::vector<FunctionCall>& calls) const {
  const LiftedAction& action = actions_[instance.schema.index()];
  Binding binding(action.slots);
  std::ranges::copy(instance.arguments, binding.begin());
  const Reader::Visit visit = [&](const LiftedExpression& application, const Binding& bound) {
    FunctionCall call;
    call.module = symbols_[application.function].module;
    call.function = symbols_[application.function].name;
    for (const auto argument : application.arguments)
      call.arguments.push_back(symbols_.name(resolve(argument, bound)));
    calls.push_back(std::move(call));
  };
  Reader(symbols_, binding, visit).read(action);
}

void ActionTuples::collect(const std::string& action, const std::vector<std::string>& arguments,
                           std::vector<FunctionCall>& calls) const {
  const auto found = std::ranges::find_if(
      actions_, [&](const LiftedAction& one) { return !one.layer && one.name == action; });
  if (found == actions_.end()) return;
  ActionInstance instance{task::SchemaId(static_cast<std::size_t>(found - actions_.begin())), {}};
  for (const std::string& argument : arguments) instance.arguments.push_back(symbols_.object(argument));
  collect(instance, calls);
}

}  // namespace roci::planner::temporal_pddl::values
