#include "planner_svc/temporal_pddl/task/derived_facts.hpp"

#include <algorithm>
#include <map>

namespace roci::planner::temporal_pddl::task {

DerivedFacts::DerivedFacts(std::span<const DerivationRule> rules) {
  std::map<FactId, std::uint32_t> index;  // of heads_
  std::vector<int> layers;                // by head
  for (const DerivationRule& rule : rules) {
    if (!index.emplace(rule.head, static_cast<std::uint32_t>(heads_.size())).second) continue;
    heads_.push_back(rule.head);
    layers.push_back(rule.layer);
  }
  std::vector<std::vector<std::uint32_t>> awaited_by(heads_.size());
  for (std::uint32_t i = 0; i < rules.size(); ++i) {
    const DerivationRule& rule = rules[i];
    std::vector<FactId> settled;
    std::uint32_t awaited = 0;
    for (const FactId condition : rule.conditions) {
      const auto head = index.find(condition);
      if (head == index.end() || layers[head->second] != rule.layer) {
        settled.push_back(condition);
      } else {
        awaited_by[head->second].push_back(i);
        ++awaited;
      }
    }
    rules_.push_back({index.at(rule.head), awaited});
    settled_.push_back(settled);
    comparisons_.push_back(rule.comparisons);
    if (i + 1 == rules.size() || rules[i + 1].layer != rule.layer) layer_ends_.push_back(i + 1);
  }
  for (const auto& list : awaited_by) awaited_by_.push_back(list);
}

void DerivedFacts::complete(const StateLayout& layout, const ExpressionPool& expressions,
                            MutableState state) const {
  constexpr std::uint32_t kBlocked = 0xffffffff;
  for (const FactId head : heads_) layout.remove(state, head);
  std::vector<std::uint32_t> awaited(rules_.size());
  std::vector<std::uint32_t> found;  // heads
  const auto derive = [&](std::uint32_t head) {
    if (layout.holds(state, heads_[head])) return;
    layout.add(state, heads_[head]);
    found.push_back(head);
  };
  std::uint32_t begin = 0;
  for (const std::uint32_t end : layer_ends_) {
    for (std::uint32_t i = begin; i < end; ++i) {
      const bool open =
          std::ranges::all_of(settled_[i], [&](FactId fact) { return layout.holds(state, fact); }) &&
          std::ranges::all_of(comparisons_[i], [&](const NumericCondition& comparison) {
            return holds(comparison.comparator,
                         evaluate(expressions[comparison.expression], layout.numbers(state), 0));
          });
      awaited[i] = open ? rules_[i].awaited : kBlocked;
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      if (awaited[i] == 0) derive(rules_[i].head);
    }
    while (!found.empty()) {
      const std::uint32_t head = found.back();
      found.pop_back();
      for (const std::uint32_t rule : awaited_by_[head]) {
        if (awaited[rule] != kBlocked && --awaited[rule] == 0) derive(rules_[rule].head);
      }
    }
    begin = end;
  }
}

}  // namespace roci::planner::temporal_pddl::task
