#include "planner_svc/temporal_pddl/grounding/instantiation/action_instantiator.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace roci::planner::temporal_pddl::grounding::instantiation {

using lifted::Binding, lifted::LiftedAction, lifted::LiftedEffect, lifted::StaticModel,
    lifted::for_each_value, lifted::objects_of;
using task::LinearExpression, task::NumberId, task::SchemaId;
using temporal::Duration, temporal::no_bound;

namespace {

void append(GroundEffects& to, const GroundEffects& more) {
  to.adds.insert(to.adds.end(), more.adds.begin(), more.adds.end());
  to.deletes.insert(to.deletes.end(), more.deletes.begin(), more.deletes.end());
  to.numeric.insert(to.numeric.end(), more.numeric.begin(), more.numeric.end());
}

// Sorts the effects. What is both deleted and added is added, and noted in `resets`.
void normalise(GroundEffects& effects) {
  for (auto* list : {&effects.adds, &effects.deletes}) {
    std::ranges::sort(*list);
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  effects.resets.clear();
  std::ranges::set_intersection(effects.deletes, effects.adds, std::back_inserter(effects.resets));
  task::ShortList<std::uint32_t> deletes;
  std::ranges::set_difference(effects.deletes, effects.adds, std::back_inserter(deletes));
  effects.deletes = std::move(deletes);
}

// What lasts longer lasts this long: sums of a few such times still have a number, and no plan can tell them.
constexpr Duration kLongest{std::int64_t{1'000'000'000'000'000'000}};

// Rounds to microseconds so that no allowed duration is lost by more than the rounding of the numbers
// themselves.
Duration microseconds(double seconds, double (*round)(double)) {
  constexpr auto kLargest = static_cast<double>(kLongest.count());
  const double scaled = std::max(seconds * 1e6, -kLargest);
  if (scaled >= kLargest) return no_bound;
  const double nearest = std::round(scaled);
  return Duration(static_cast<std::int64_t>(std::abs(scaled - nearest) < 1e-3 ? nearest : round(scaled)));
}

}  // namespace

void ActionInstantiator::instantiate(SchemaId schema, const LiftedAction& action, Binding& binding,
                                     GroundModel& model) {
  GroundAction ground;
  ground.schema = schema;
  ground.arguments.assign(binding.begin(),
                          binding.begin() + static_cast<std::ptrdiff_t>(action.parameters.size()));
  ground.durative = action.durative;
  if (!set_duration(action, binding, ground)) return;
  const Disjunction at_start = formulas_.ground(action.at_start, binding);
  const Disjunction over_all = formulas_.ground(action.over_all, binding);
  const Disjunction at_end = formulas_.ground(action.at_end, binding);
  if (at_start.empty() || over_all.empty() || at_end.empty()) return;
  if (!collect_effects(action, binding)) return;
  add_choice_reads(action, binding);
  const std::vector<Draft> drafts = choose_conditionals();
  const std::size_t variants = at_start.size() * over_all.size() * at_end.size() * drafts.size();
  if (variants > kMaxAlternatives) {
    formulas_.fail(action.where,
                   "action " + action.name + " has over " + std::to_string(kMaxAlternatives) +
                       " combinations of alternatives and conditional effects",
                   "split the action");
  }
  for (const auto& draft : drafts) {
    for (const auto& start : at_start) {
      const auto start_condition = merged(start, draft.at_start);
      if (!start_condition) continue;
      for (const auto& end : at_end) {
        const auto end_condition = merged(end, draft.at_end);
        if (!end_condition) continue;
        for (const auto& invariant : over_all) {
          ground.at_start = *start_condition;
          ground.over_all = invariant;
          ground.at_end = *end_condition;
          ground.read_sets = reads_beside(*start_condition, *end_condition, model.read_sets);
          ground.start_effects = draft.start_effects;
          ground.end_effects = draft.end_effects;
          normalise(ground.start_effects);
          normalise(ground.end_effects);
          model.actions.push_back(ground);
        }
      }
    }
  }
}

bool ActionInstantiator::set_duration(const LiftedAction& action, const Binding& binding,
                                      GroundAction& ground) {
  using enum pddl::ComparisonOperator;
  ground.max_duration = action.durative ? no_bound : Duration{0};
  for (const auto& rule : action.duration) {
    const auto bound = formulas_.linear(rule.bound, binding);
    if (!bound) return false;
    if (!bound->is_constant()) {
      ground.duration_rules.push_back({formulas_.intern(*bound), rule.op != less_equal && rule.op != less,
                                       rule.op != greater_equal && rule.op != greater,
                                       rule.at == pddl::TimePoint::end});
      continue;
    }
    if (rule.op == equal) {
      const Duration fixed = microseconds(bound->constant, std::round);
      ground.min_duration = std::max(ground.min_duration, fixed);
      ground.max_duration = std::min(ground.max_duration, fixed);
    } else if (rule.op == greater_equal || rule.op == greater) {
      ground.min_duration = std::max(ground.min_duration, microseconds(bound->constant, std::ceil));
    } else {
      ground.max_duration = std::min(ground.max_duration, microseconds(bound->constant, std::floor));
    }
  }
  ground.min_duration = std::min(ground.min_duration, kLongest);
  return ground.min_duration <= ground.max_duration;
}

void ActionInstantiator::add_choice_reads(const LiftedAction& action, Binding& binding) {
  if (has_choice(action.at_start)) formulas_.read(action.at_start, binding, false, reads_);
  if (has_choice(action.at_end)) formulas_.read(action.at_end, binding, true, reads_);
  std::ranges::sort(reads_);
  reads_.erase(std::unique(reads_.begin(), reads_.end()), reads_.end());
}

// Returns an index of `lists`: what the action reads beside what its conditions ask for themselves.
std::uint32_t ActionInstantiator::reads_beside(const Conjunction& at_start, const Conjunction& at_end,
                                               std::vector<std::vector<ReadVariable>>& lists) const {
  std::vector<ReadVariable> result;
  std::ranges::copy_if(reads_, std::back_inserter(result), [&](const ReadVariable& read) {
    const auto& literals = (read.at_end ? at_end : at_start).literals;
    return read.is_number ||
           std::ranges::none_of(literals, [&](GroundLiteral literal) { return literal.atom == read.index; });
  });
  if (result.empty()) return 0;
  if (result != lists.back()) lists.push_back(std::move(result));
  return static_cast<std::uint32_t>(lists.size() - 1);
}

bool ActionInstantiator::collect_effects(const LiftedAction& action, Binding& binding) {
  unconditional_ = {};
  conditionals_.clear();
  reads_.clear();
  bool defined = true;
  for (const bool at_end : {false, true}) {
    for (const auto& effect : at_end ? action.end_effects : action.start_effects) {
      for_each_value(effect.quantified, binding,
                     [&] { defined = defined && collect_effect(effect, at_end, binding); });
    }
  }
  return defined;
}

bool ActionInstantiator::collect_effect(const LiftedEffect& effect, bool at_end, Binding& binding) {
  const auto effects_of = [&](auto& draft) -> GroundEffects& {
    return at_end ? draft.end_effects : draft.start_effects;
  };
  if (!effect.conditional()) return add_effect(effect, binding, effects_of(unconditional_));
  formulas_.read(effect.start_condition, binding, false, reads_);
  formulas_.read(effect.end_condition, binding, true, reads_);
  const StaticModel& static_model = formulas_.static_model();
  if (!static_model.possible(effect.start_condition, binding) ||
      !static_model.possible(effect.end_condition, binding))
    return true;

  const Disjunction at_start = formulas_.ground(effect.start_condition, binding);
  const Disjunction before_end = formulas_.ground(effect.end_condition, binding);
  Conditional conditional;
  for (const auto& start : at_start) {
    for (const auto& end : before_end) conditional.fires.emplace_back(start, end);
  }
  if (conditional.fires.empty()) return true;
  const bool fires_always = std::ranges::any_of(
      conditional.fires, [](const auto& c) { return c.first.empty() && c.second.empty(); });
  if (fires_always || changes_its_condition(effect, at_end, binding, conditional.fires)) {
    return add_effect(effect, binding, effects_of(unconditional_));
  }
  for (auto& same : conditionals_) {
    if (same.fires == conditional.fires) return add_effect(effect, binding, effects_of(same));
  }
  if (!effect.start_condition.is_true()) {
    for (const auto& start : formulas_.ground(effect.start_otherwise, binding)) {
      conditional.otherwise.emplace_back(start, Conjunction{});
    }
  }
  if (!effect.end_condition.is_true()) {
    for (const auto& end : formulas_.ground(effect.end_otherwise, binding)) {
      conditional.otherwise.emplace_back(Conjunction{}, end);
    }
  }
  if (!add_effect(effect, binding, effects_of(conditional))) return false;
  conditionals_.push_back(std::move(conditional));
  return true;
}

// (when (p) (not (p))) says no more than (not (p)), and (when (not (p)) (p)) no more than (p).
bool ActionInstantiator::changes_its_condition(
    const LiftedEffect& effect, bool at_end, const Binding& binding,
    const std::vector<std::pair<Conjunction, Conjunction>>& fires) const {
  if (effect.kind == LiftedEffect::Kind::numeric || fires.size() != 1) return false;
  const auto& [start, end] = fires.front();
  const Conjunction& same_time = at_end ? end : start;
  const Conjunction& other_time = at_end ? start : end;
  const auto atom = formulas_.reached_atom(effect.atom, binding);
  return atom && other_time.empty() && same_time.comparisons.empty() && same_time.literals.size() == 1 &&
         same_time.literals.front() == GroundLiteral{*atom, effect.kind == LiftedEffect::Kind::add};
}

bool ActionInstantiator::add_effect(const LiftedEffect& effect, const Binding& binding,
                                    GroundEffects& effects) {
  if (effect.kind != LiftedEffect::Kind::numeric) {
    const bool adds = effect.kind == LiftedEffect::Kind::add;
    const auto atom =
        adds ? formulas_.reached_atom(effect.atom, binding) : formulas_.known_atom(effect.atom, binding);
    if (atom) (adds ? effects.adds : effects.deletes).push_back(*atom);
    return true;
  }
  auto value = formulas_.linear(effect.value, binding);
  if (!value) return false;
  const NumberId number = formulas_.number(effect.function, objects_of(effect.atom.arguments, binding));
  bool assigns = false;
  switch (effect.op) {
    case pddl::AssignmentOperator::assign:
      assigns = true;
      break;
    case pddl::AssignmentOperator::increase:
      break;
    case pddl::AssignmentOperator::decrease:
      value = scaled(*value, -1);
      break;
    case pddl::AssignmentOperator::scale_up:
    case pddl::AssignmentOperator::scale_down: {
      if (!value->is_constant()) {
        formulas_.fail(effect.where, "scaling by a number that changes is not linear", "scale by a constant");
      }
      const bool up = effect.op == pddl::AssignmentOperator::scale_up;
      if (!up && value->constant == 0) return false;
      LinearExpression product;
      product.terms.push_back({number, up ? value->constant : 1 / value->constant});
      if (product.terms.front().weight == 0) product.terms.clear();
      value = product;
      assigns = true;
      break;
    }
  }
  effects.numeric.push_back({number, assigns, formulas_.intern(*value)});
  return true;
}

// Returns every way to let each group of conditional effects happen or not.
std::vector<ActionInstantiator::Draft> ActionInstantiator::choose_conditionals() const {
  std::vector<Draft> drafts{unconditional_};
  for (const auto& conditional : conditionals_) {
    std::vector<Draft> longer;
    for (const auto& draft : drafts) {
      for (const bool fires : {true, false}) {
        for (const auto& [start, end] : fires ? conditional.fires : conditional.otherwise) {
          const auto at_start = merged(draft.at_start, start);
          const auto at_end = merged(draft.at_end, end);
          if (!at_start || !at_end) continue;
          Draft next{*at_start, *at_end, draft.start_effects, draft.end_effects};
          if (fires) {
            append(next.start_effects, conditional.start_effects);
            append(next.end_effects, conditional.end_effects);
          }
          longer.push_back(std::move(next));
        }
      }
    }
    drafts = std::move(longer);
    if (drafts.size() > kMaxAlternatives) break;  // refused by the caller
  }
  return drafts;
}

}  // namespace roci::planner::temporal_pddl::grounding::instantiation
