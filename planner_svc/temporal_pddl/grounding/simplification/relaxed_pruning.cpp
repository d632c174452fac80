#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

#include <algorithm>
#include <iterator>
#include <span>

namespace roci::planner::temporal_pddl::grounding::simplification {

using call::SearchLimits;
using instantiation::Conjunction, instantiation::GroundAction, instantiation::GroundEffects,
    instantiation::GroundLiteral, instantiation::GroundModel;

namespace {

bool achieves(const GroundEffects& effects, GroundLiteral literal) {
  return std::ranges::binary_search(literal.negated ? effects.deletes : effects.adds, literal.atom);
}

class RelaxedReach {
 public:
  RelaxedReach(const GroundModel& model, SearchLimits& limits)
      : model_(model),
        limits_(limits),
        reached_(2 * model.atoms.size(), false),
        waiting_(2 * model.atoms.size()),
        missing_(2 * model.actions.size() + model.rules.size(), 0) {}

  void run() {
    std::vector<bool> initially(model_.atoms.size(), false);
    for (const std::uint32_t atom : model_.initial_atoms) initially[atom] = true;
    for (std::uint32_t atom = 0; atom < initially.size(); ++atom) reach({atom, !initially[atom]});
    for (const auto& timed : model_.timed) take_effects(timed.effects);
    for (std::size_t i = 0; i < model_.rules.size(); ++i)
      await(static_cast<std::uint32_t>(2 * model_.actions.size() + i), model_.rules[i].body.literals, 0);
    for (std::uint32_t i = 0; i < model_.actions.size(); ++i) {
      limits_.step();
      const GroundAction& action = model_.actions[i];
      std::vector<GroundLiteral> end;
      std::ranges::set_union(action.over_all.literals, action.at_end.literals, std::back_inserter(end));
      await(2 * i + 1, end, 1);  // and the start
      await(2 * i, start_requirements(model_, action), 0);
    }
    while (!queue_.empty()) {
      limits_.step();
      const std::size_t literal = queue_.back();
      queue_.pop_back();
      for (const std::size_t snap : waiting_[literal]) count_down(snap);
    }
  }

  const std::vector<bool>& reached() const { return reached_; }
  bool ends(std::size_t action) const { return missing_[2 * action + 1] == 0; }
  bool derives(std::size_t rule) const { return missing_[2 * model_.actions.size() + rule] == 0; }

 private:
  void reach(GroundLiteral literal) {
    const std::size_t index = literal_index(literal);
    if (reached_[index]) return;
    reached_[index] = true;
    queue_.push_back(index);
  }

  // Literals that are queued still count as missing until they are taken.
  void await(std::uint32_t snap, std::span<const GroundLiteral> literals, std::uint32_t more) {
    missing_[snap] = static_cast<std::uint32_t>(literals.size()) + more;
    for (const auto literal : literals) waiting_[literal_index(literal)].push_back(snap);
    if (missing_[snap] == 0) happen(snap);
  }

  void count_down(std::size_t snap) {
    if (--missing_[snap] == 0) happen(snap);
  }

  void happen(std::size_t snap) {
    if (snap >= 2 * model_.actions.size()) return reach(model_.rules[snap - 2 * model_.actions.size()].head);
    const GroundAction& action = model_.actions[snap / 2];
    take_effects(snap % 2 == 0 ? action.start_effects : action.end_effects);
    if (snap % 2 == 0) count_down(snap + 1);
  }

  void take_effects(const GroundEffects& effects) {
    for (const std::uint32_t atom : effects.adds) reach({atom, false});
    for (const std::uint32_t atom : effects.deletes) reach({atom, true});
  }

  const GroundModel& model_;
  SearchLimits& limits_;
  std::vector<bool> reached_;
  std::vector<std::vector<std::uint32_t>> waiting_;  // by literal: starts, ends and rules
  std::vector<std::uint32_t> missing_;               // by start and end of each action, then by rule
  std::vector<std::size_t> queue_;
};

// Returns by literal index whether some effect brings the literal about.
std::vector<bool> brought_about(const GroundModel& model) {
  std::vector<bool> result(2 * model.atoms.size(), false);
  const auto note = [&](const GroundEffects& effects) {
    for (const std::uint32_t atom : effects.adds) result[literal_index({atom, false})] = true;
    for (const std::uint32_t atom : effects.deletes) result[literal_index({atom, true})] = true;
  };
  for (const auto& action : model.actions) {
    note(action.start_effects);
    note(action.end_effects);
  }
  for (const auto& timed : model.timed) note(timed.effects);
  return result;
}

// Keeps the elements whose index satisfies the predicate, in place, since there may be many.
template <typename T, typename Predicate>
void keep(std::vector<T>& list, const Predicate& wanted) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!wanted(i)) continue;
    if (kept < i) list[kept] = std::move(list[i]);
    ++kept;
  }
  list.resize(kept);
}

}  // namespace

std::vector<GroundLiteral> start_requirements(const GroundModel& model, const GroundAction& action) {
  std::vector<GroundLiteral> result(action.at_start.literals.begin(), action.at_start.literals.end());
  for (const auto literal : action.over_all.literals) {
    if (!model.derived[literal.atom] && !achieves(action.start_effects, literal)) result.push_back(literal);
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<bool> prune(GroundModel& model, SearchLimits& limits) {
  while (true) {
    RelaxedReach reach(model, limits);
    reach.run();
    const std::size_t before = model.actions.size();
    keep(model.actions, [&](std::size_t i) { return reach.ends(i); });
    if (model.actions.size() < before) continue;

    keep(model.rules, [&](std::size_t i) { return reach.derives(i); });

    const auto& reached = reach.reached();
    const std::vector<bool> brought = brought_about(model);
    const auto certain = [&](GroundLiteral literal) {
      return !reached[literal_index({literal.atom, !literal.negated})];
    };
    const auto drop_certain = [&](Conjunction& conjunction) { erase_if(conjunction.literals, certain); };
    const auto drop_untouched = [&](Conjunction& conjunction) {
      erase_if(conjunction.literals,
               [&](GroundLiteral literal) { return certain(literal) && !brought[literal_index(literal)]; });
    };
    for (auto& action : model.actions) {
      drop_certain(action.over_all);
      drop_untouched(action.at_start);
      drop_untouched(action.at_end);
    }
    for (auto& rule : model.rules) drop_untouched(rule.body);
    std::erase_if(model.goal, [&](const Conjunction& goal) {
      return !std::ranges::all_of(goal.literals,
                                  [&](auto literal) { return reached[literal_index(literal)]; });
    });
    for (auto& goal : model.goal) drop_certain(goal);
    return reached;
  }
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
