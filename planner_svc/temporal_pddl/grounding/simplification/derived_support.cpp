#include "planner_svc/temporal_pddl/grounding/simplification/derived_support.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/instantiation/formula_grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding::simplification {

using instantiation::Conjunction, instantiation::Disjunction, instantiation::GroundLiteral,
    instantiation::GroundModel, instantiation::GroundRule, instantiation::always, instantiation::both;

namespace {

template <typename T>
void sort_unique(std::vector<T>& list) {
  std::ranges::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

DerivedSupport::DerivedSupport(const GroundModel& model) : model_(model), rules_(model.atoms.size()) {
  for (std::uint32_t i = 0; i < model.rules.size(); ++i) rules_[model.rules[i].head.atom].push_back(i);
}

Support DerivedSupport::of(GroundLiteral literal) const {
  Support result;
  std::vector<GroundLiteral> open{literal};
  std::vector<bool> seen(2 * model_.atoms.size(), false);
  seen[literal_index(literal)] = true;
  while (!open.empty()) {
    const GroundLiteral at = open.back();
    open.pop_back();
    if (!is_derived(at.atom)) result.literals.push_back(at);
    for (const std::uint32_t index : rules_[at.atom]) {
      const Conjunction& body = model_.rules[index].body;
      for (const GroundLiteral part : body.literals) {
        const GroundLiteral next{part.atom, part.negated != at.negated};
        if (!seen[literal_index(next)]) open.push_back(next);
        seen[literal_index(next)] = true;
      }
      for (const auto& comparison : body.comparisons) {
        for (const auto& term : model_.expressions[comparison.expression].terms)
          result.numbers.push_back(term.variable);
      }
    }
  }
  sort_unique(result.literals);
  sort_unique(result.numbers);
  return result;
}

std::vector<GroundRule> DerivedSupport::negations(std::vector<std::uint32_t> atoms) const {
  std::vector<GroundRule> result;
  std::vector<bool> done(rules_.size(), false);
  while (!atoms.empty()) {
    const std::uint32_t atom = atoms.back();
    atoms.pop_back();
    if (!is_derived(atom) || done[atom]) continue;
    done[atom] = true;
    const std::size_t first = result.size();
    add_negations(atom, result);
    for (std::size_t i = first; i < result.size(); ++i) {
      for (const GroundLiteral literal : result[i].body.literals) {
        if (literal.negated) atoms.push_back(literal.atom);
      }
    }
  }
  return result;
}

void DerivedSupport::add_negations(std::uint32_t atom, std::vector<GroundRule>& result) const {
  Disjunction ways = always();
  for (const std::uint32_t index : rules_[atom]) {
    const GroundRule& rule = model_.rules[index];
    const bool recursive = std::ranges::any_of(rule.body.literals, [&](GroundLiteral literal) {
      return is_derived(literal.atom) && model_.rules[rules_[literal.atom].front()].layer == rule.layer;
    });
    if (recursive || !rule.body.comparisons.empty()) continue;
    Disjunction broken;
    for (const GroundLiteral literal : rule.body.literals)
      broken.push_back({{{literal.atom, !literal.negated}}, {}});
    Disjunction more = both(ways, broken);
    if (more.size() <= kMaxWays) ways = std::move(more);
  }
  const int layer = model_.rules[rules_[atom].front()].layer;
  for (auto& way : ways) result.push_back({{atom, true}, layer, std::move(way)});
}

}  // namespace roci::planner::temporal_pddl::grounding::simplification
