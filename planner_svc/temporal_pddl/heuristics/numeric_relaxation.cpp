#include "planner_svc/temporal_pddl/heuristics/numeric_relaxation.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::temporal_pddl::heuristics {

using task::ActionId, task::Comparator, task::Goal, task::LinearExpression, task::NumberId, task::NumbersView,
    task::NumericCondition, task::NumericEffect, task::Snap, task::SnapId, task::SnapKind, task::StateView,
    task::Task;

namespace {

constexpr double kMostRepeatsOfOne = 1000;

double weight_of(const LinearExpression& expression, NumberId number) {
  for (const auto& term : expression.terms) {
    if (term.variable == number) return term.weight;
  }
  return 0;
}

}  // namespace

NumericRelaxation::NumericRelaxation(const Task& task) : task_(task) {
  for (std::size_t i = 0; i < task.snaps.size(); ++i) find_needs(SnapId(i));
  for (const Goal& goal : task.goals) {
    std::vector<ComparisonId> needs;
    for (const NumericCondition& condition : goal.comparisons) needs.push_back(intern(condition));
    std::erase(needs, ComparisonId());
    goal_needs_.push_back(needs);
  }
  find_forms();
  std::vector<std::vector<SnapId>> needed_by(comparisons());
  for (std::size_t i = 0; i < task.snaps.size(); ++i) {
    for (const ComparisonId need : needs_[SnapId(i)]) needed_by[need.index()].push_back(SnapId(i));
    find_changes(SnapId(i));
  }
  for (const auto& list : needed_by) needed_by_.push_back(list);
}

std::size_t NumericRelaxation::bytes() const {
  return needs_.bytes() + needed_by_.bytes() + forms_.bytes() + of_form_.bytes() + touches_.bytes() +
         raised_.bytes() + raises_.bytes();
}

ComparisonId NumericRelaxation::intern(const NumericCondition& condition) {
  if (task_.expressions[condition.expression].duration_weight != 0) return {};
  const auto [place, fresh] = ids_.try_emplace(condition, ComparisonId(conditions_.size()));
  if (fresh) conditions_.push_back(condition);
  return place->second;
}

void NumericRelaxation::find_needs(SnapId op) {
  std::vector<ComparisonId> needs;
  for (const NumericCondition& condition : task_.comparisons[op]) needs.push_back(intern(condition));
  const Snap& snap = task_.snaps[op];
  if (snap.kind == SnapKind::start) {
    for (const NumericCondition& condition : task_.numeric_invariants[snap.action]) {
      if (!changed_by(op, task_.expressions[condition.expression])) needs.push_back(intern(condition));
    }
  }
  std::erase(needs, ComparisonId());
  std::ranges::sort(needs);
  needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
  needs_.push_back(needs);
}

bool NumericRelaxation::changed_by(SnapId op, const LinearExpression& expression) const {
  return std::ranges::any_of(task_.numeric_effects[op], [&](const NumericEffect& effect) {
    return weight_of(expression, effect.variable) != 0;
  });
}

void NumericRelaxation::find_forms() {
  std::map<std::vector<LinearExpression::Term>, FormId> forms;
  std::vector<std::vector<ComparisonId>> of_form;
  for (std::size_t i = 0; i < comparisons(); ++i) {
    const ComparisonId id(i);
    const auto [place, fresh] = forms.try_emplace(expression(id).terms, FormId(forms.size()));
    if (fresh) of_form.emplace_back();
    of_form[place->second.index()].push_back(id);
    forms_.push_back(place->second);
  }
  for (const auto& list : of_form) of_form_.push_back(list);
}

void NumericRelaxation::find_changes(SnapId op) {
  std::vector<FormId> touches;
  std::vector<Raise> raises;
  for (std::size_t i = 0; i < forms() && !task_.numeric_effects[op].empty(); ++i) {
    const FormId form(i);
    if (!changed_by(op, expression(form))) continue;
    touches.push_back(form);
    raises.emplace_back(form, raises_all(op, form));
  }
  touches_.push_back(touches);
  raises_.push_back(intern_raised(std::move(raises)));
}

bool NumericRelaxation::raises_all(SnapId op, FormId form) const {
  bool known = true;
  double change = 0;
  for (const NumericEffect& effect : task_.numeric_effects[op]) {
    const LinearExpression& by = task_.expressions[effect.expression];
    const double weight = weight_of(expression(form), effect.variable);
    known = known && (weight == 0 || (!effect.assigns && by.is_constant()));
    change += weight * by.constant;
  }
  return !known || change > 0;
}

std::uint32_t NumericRelaxation::intern_raised(std::vector<Raise> raises) {
  const auto [place, fresh] =
      raised_by_.try_emplace(std::move(raises), static_cast<std::uint32_t>(raised_.size()));
  if (!fresh) return place->second;
  std::vector<ComparisonId> raised;
  for (const auto& [form, all] : place->first)
    for (const ComparisonId id : of_form_[form])
      if (all || conditions_[id].comparator == Comparator::equal) raised.push_back(id);
  std::ranges::sort(raised);
  raised_.push_back(raised);
  return place->second;
}

double NumericRelaxation::value(ComparisonId comparison, StateView state) const {
  return evaluate(expression(comparison), task_.layout.numbers(state), 0);
}

bool NumericRelaxation::satisfies(ComparisonId comparison, double value) const {
  return task::holds(conditions_[comparison].comparator, value);
}

double NumericRelaxation::change(SnapId op, FormId form, StateView state) const {
  const NumbersView numbers = task_.layout.numbers(state);
  const ActionId action = task_.snaps[op].action;
  const double seconds =
      action.is_none() ? 0 : std::chrono::duration<double>(task_.actions[action].min_duration).count();
  double change = 0;
  for (const NumericEffect& effect : task_.numeric_effects[op]) {
    const double weight = weight_of(expression(form), effect.variable);
    if (weight == 0) continue;
    if (effect.assigns) return 0;
    change += weight * evaluate(task_.expressions[effect.expression], numbers, seconds);
  }
  return std::isfinite(change) ? change : 0;
}

double NumericRelaxation::whole_change(SnapId op, FormId form, StateView state) const {
  const SnapId other = task_.other_end(op);
  return change(op, form, state) + (other.is_none() ? 0 : change(other, form, state));
}

std::int64_t NumericRelaxation::repeats(SnapId op, ComparisonId comparison, StateView state) const {
  const double gain = change(op, form(comparison), state);
  const double missing = -value(comparison, state);
  if (!(gain > 0) || !(missing > gain)) return 1;
  return static_cast<std::int64_t>(std::min(kMostRepeatsOfOne, std::ceil(missing / gain - 1e-9)));
}

}  // namespace roci::planner::temporal_pddl::heuristics
