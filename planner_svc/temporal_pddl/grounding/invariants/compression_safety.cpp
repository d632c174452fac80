#include "planner_svc/temporal_pddl/grounding/invariants/compression_safety.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <span>

#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding::invariants {

using call::SearchLimits;
using instantiation::Conjunction, instantiation::GroundAction, instantiation::GroundEffects,
    instantiation::GroundLiteral, instantiation::GroundModel, instantiation::GroundRule,
    instantiation::ReadVariable;
using simplification::start_requirements;
using task::DurationRule, task::ExpressionId, task::NumericCondition, task::NumericEffect;

namespace {

using Groups = std::vector<std::uint32_t>;  // ascending indices of mutex groups

bool contains(std::span<const std::uint32_t> sorted, std::uint32_t value) {
  return std::ranges::binary_search(sorted, value);
}

Groups united(const Groups& a, const Groups& b) {
  Groups result;
  std::ranges::set_union(a, b, std::back_inserter(result));
  return result;
}

bool intersect(const Groups& a, const Groups& b) {
  for (const std::uint32_t group : a) {
    if (contains(b, group)) return true;
  }
  return false;
}

// Tells what may touch a variable: a single action, or several, of which the groups are kept that every
// toucher needs a member of.
class Touch {
 public:
  void by(std::size_t action, const Groups& needed) {
    if (!common_) {
      common_ = needed;
      sole_ = action;
      return;
    }
    if (sole_ != action) sole_ = nobody;
    Groups kept;
    std::ranges::set_intersection(*common_, needed, std::back_inserter(kept));
    common_ = std::move(kept);
  }
  // Returns whether no other action can reach the variable while the action runs, which is a member of these
  // groups.
  bool isolated(std::size_t action, const Groups& running) const {
    return common_ && (sole_ == action || intersect(*common_, running));
  }

  static constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();

 private:
  std::optional<Groups> common_;
  std::size_t sole_ = nobody;
};

class Analysis {
 public:
  Analysis(const GroundModel& model, const std::vector<MutexGroup>& groups, SearchLimits& limits)
      : model_(model),
        groups_of_(model.atoms.size()),
        running_(model.actions.size()),
        atoms_(model.atoms.size()),
        numbers_(model.numbers.size()),
        adders_(model.atoms.size()),
        facts_(model.atoms.size()),
        only_goals_ask_(only_goals_ask(model)) {
    for (std::uint32_t group = 0; group < groups.size(); ++group) {
      for (const std::uint32_t atom : groups[group].atoms) groups_of_[atom].push_back(group);
      for (const std::uint32_t action : groups[group].running) running_[action].push_back(group);
    }
    for (std::size_t i = 0; i < model.actions.size(); ++i) {
      touch_by_action(i);
      limits.step();
    }
    for (const auto& timed : model.timed) touch_by_snap(Touch::nobody, timed.effects, {}, {});
    for (const auto& rule : model.rules) touch_by_rule(rule);
  }

  Compression judge(std::size_t index) const {
    const GroundAction& action = model_.actions[index];
    const Groups& running = running_[index];
    Compression result;
    if (!action.durative || !ends_freely(index, running)) return result;
    for (const std::uint32_t atom : action.end_effects.deletes) {
      if (!atoms_[atom].isolated(index, running)) return result;
    }
    for (const std::uint32_t atom : action.end_effects.adds) {
      if (atoms_[atom].isolated(index, running) || only_goals_ask_[atom]) continue;
      if (facts_[atom].deleted || facts_[atom].negated || contains(action.start_effects.adds, atom))
        return result;
      if (!adders_[atom].isolated(index, running)) return result;
      result.absent.push_back(atom);
    }
    result.safe = true;
    return result;
  }

 private:
  struct FactUse {
    bool deleted = false;
    bool negated = false;            // in some condition
    bool redundantly_added = false;  // perhaps, while it is true
    bool redundantly_deleted = false;
  };

  Groups needs(std::span<const GroundLiteral> literals) const {
    Groups result;
    for (const auto literal : literals) {
      if (!literal.negated) result = united(result, groups_of_[literal.atom]);
    }
    return result;
  }

  void touch_by_action(std::size_t index) {
    const GroundAction& action = model_.actions[index];
    const auto start_literals = start_requirements(model_, action);
    std::vector<GroundLiteral> end_literals;
    std::ranges::set_union(action.at_end.literals, action.over_all.literals,
                           std::back_inserter(end_literals));
    const Groups start_needs = needs(start_literals);
    touch_by_conditions(index, action.at_start, start_needs);
    touch_by_reads(index, false, start_needs);
    touch_by_snap(index, action.start_effects, start_needs, start_literals);
    for (const auto& rule : action.duration_rules) touch_by_expression(index, rule.bound, start_needs);
    if (!action.durative) return;
    const Groups end_needs = united(running_[index], needs(end_literals));
    touch_by_conditions(index, action.at_end, end_needs);
    touch_by_reads(index, true, end_needs);
    touch_by_snap(index, action.end_effects, end_needs, end_literals);
    for (const auto& rule : action.duration_rules) touch_by_expression(index, rule.bound, end_needs);
    touch_by_conditions(index, action.over_all, united(running_[index], needs(action.over_all.literals)));
    touch_by_conditions(index, action.over_all, start_needs);
    touch_by_conditions(index, action.over_all, end_needs);
  }

  // Whoever asks for a derived atom may ask for what it hangs on, at any time and true or false.
  void touch_by_rule(const GroundRule& rule) {
    touch_by_conditions(Touch::nobody, rule.body, {});
    atoms_[rule.head.atom].by(Touch::nobody, {});
    facts_[rule.head.atom] = {true, true, true, true};
    for (const auto literal : rule.body.literals) facts_[literal.atom].negated = true;
  }

  void touch_by_reads(std::size_t index, bool at_end, const Groups& needed) {
    for (const ReadVariable& read : model_.read_set_of(model_.actions[index])) {
      if (read.at_end != at_end) continue;
      (read.is_number ? numbers_ : atoms_)[read.index].by(index, needed);
      if (!read.is_number) facts_[read.index].negated = true;  // true or false, it is looked at
    }
  }

  void touch_by_expression(std::size_t index, ExpressionId expression, const Groups& needed) {
    for (const auto& term : model_.expressions[expression].terms)
      numbers_[term.variable.index()].by(index, needed);
  }

  void touch_by_conditions(std::size_t index, const Conjunction& conditions, const Groups& needed) {
    for (const auto literal : conditions.literals) {
      atoms_[literal.atom].by(index, needed);
      facts_[literal.atom].negated = facts_[literal.atom].negated || literal.negated;
    }
    for (const auto& comparison : conditions.comparisons)
      touch_by_expression(index, comparison.expression, needed);
  }

  void touch_by_snap(std::size_t index, const GroundEffects& effects, const Groups& needed,
                     std::span<const GroundLiteral> literals) {
    for (const std::uint32_t atom : effects.adds) {
      atoms_[atom].by(index, needed);
      adders_[atom].by(index, needed);
      const bool only_while_false =
          std::ranges::any_of(literals,
                              [&](GroundLiteral literal) {
                                return literal.atom == atom
                                           ? literal.negated
                                           : !literal.negated &&
                                                 intersect(groups_of_[literal.atom], groups_of_[atom]);
                              }) ||
          (intersect(needed, groups_of_[atom]) &&
           std::ranges::none_of(literals, [&](GroundLiteral literal) { return literal.atom == atom; }));
      facts_[atom].redundantly_added = facts_[atom].redundantly_added || !only_while_false;
    }
    for (const std::uint32_t atom : effects.resets) facts_[atom].deleted = true;
    for (const std::uint32_t atom : effects.deletes) {
      atoms_[atom].by(index, needed);
      facts_[atom].deleted = true;
      if (!std::ranges::binary_search(literals, GroundLiteral{atom, false}))
        facts_[atom].redundantly_deleted = true;
    }
    for (const auto& effect : effects.numeric) {
      numbers_[effect.variable.index()].by(index, needed);
      touch_by_expression(index, effect.expression, needed);
    }
  }

  bool isolated(std::size_t index, const Conjunction& conditions, const Groups& running) const {
    return std::ranges::all_of(conditions.comparisons, [&](const NumericCondition& comparison) {
      return std::ranges::all_of(model_.expressions[comparison.expression].terms, [&](const auto& term) {
        return numbers_[term.variable.index()].isolated(index, running);
      });
    });
  }

  // Checks points 1, 2 and 4 of the criterion.
  bool ends_freely(std::size_t index, const Groups& running) const {
    const GroundAction& action = model_.actions[index];
    const bool literals_free = std::ranges::all_of(action.at_end.literals, [&](GroundLiteral literal) {
      if (atoms_[literal.atom].isolated(index, running)) return true;
      const FactUse& use = facts_[literal.atom];
      return std::ranges::binary_search(action.over_all.literals, literal) &&
             !(literal.negated ? use.redundantly_deleted : use.redundantly_added);
    });
    const bool reads_free = std::ranges::all_of(model_.read_set_of(action), [&](const ReadVariable& read) {
      const Touch& touch = (read.is_number ? numbers_ : atoms_)[read.index];
      return !read.at_end || touch.isolated(index, running);
    });
    // A derived invariant may hold for one reason, then for another.
    const bool simple = std::ranges::none_of(
        action.over_all.literals, [&](GroundLiteral literal) { return model_.derived[literal.atom]; });
    return literals_free && reads_free && simple && isolated(index, action.over_all, running) &&
           isolated(index, action.at_end, running) &&
           std::ranges::none_of(action.duration_rules,
                                [](const DurationRule& rule) { return rule.at_end; }) &&
           std::ranges::all_of(action.end_effects.numeric, [&](const NumericEffect& effect) {
             return numbers_[effect.variable.index()].isolated(index, running);
           });
  }

  const GroundModel& model_;
  std::vector<Groups> groups_of_;  // by atom
  std::vector<Groups> running_;    // by action
  std::vector<Touch> atoms_, numbers_, adders_;
  std::vector<FactUse> facts_;
  std::vector<bool> only_goals_ask_;
};

}  // namespace

std::vector<Compression> find_compression(const GroundModel& model, const std::vector<MutexGroup>& groups,
                                          SearchLimits& limits) {
  const Analysis analysis(model, groups, limits);
  std::vector<Compression> result;
  for (std::size_t i = 0; i < model.actions.size(); ++i) {
    result.push_back(analysis.judge(i));
    limits.step();
  }
  return result;
}

std::vector<bool> only_goals_ask(const GroundModel& model) {
  std::vector<bool> result(model.atoms.size(), true);
  for (const auto& action : model.actions) {
    for (const auto* conditions : {&action.at_start, &action.over_all, &action.at_end}) {
      for (const auto literal : conditions->literals) result[literal.atom] = false;
    }
    for (const ReadVariable& read : model.read_set_of(action)) {
      if (!read.is_number) result[read.index] = false;
    }
    for (const auto* effects : {&action.start_effects, &action.end_effects}) {
      for (const std::uint32_t atom : effects->deletes) result[atom] = false;
      for (const std::uint32_t atom : effects->resets) result[atom] = false;
    }
  }
  for (const auto& timed : model.timed) {
    for (const std::uint32_t atom : timed.effects.deletes) result[atom] = false;
  }
  for (const auto& rule : model.rules) {
    for (const auto literal : rule.body.literals) result[literal.atom] = false;
  }
  for (const auto& goal : model.goal) {
    for (const auto literal : goal.literals) {
      if (literal.negated) result[literal.atom] = false;
    }
  }
  return result;
}

}  // namespace roci::planner::temporal_pddl::grounding::invariants
