#include "planner_svc/temporal_pddl/search/successor_generator.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::search {

using task::FactId, task::IdVector, task::SnapId, task::SnapKind, task::StateView, task::Task;

SuccessorGenerator::SuccessorGenerator(const Task& task) : task_(task), nodes_(1) {
  IdVector<FactId, Test> tests(task.fact_names.size());
  const auto variables = task.layout.variables();
  for (std::uint32_t variable = 0; variable < variables.size(); ++variable) {
    for (std::uint32_t i = 0; i < variables[variable].facts.size(); ++i) {
      tests[variables[variable].facts[i]] = {variable, i + 1};
    }
  }
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < task.snaps.size(); ++i) {
    const SnapId snap(i);
    const SnapKind kind = task.snaps[snap].kind;
    if (kind != SnapKind::start && kind != SnapKind::instant) continue;
    Candidate candidate{snap, {}};
    const auto test = [&](FactId fact) {
      if (!task.layout.is_negation(fact)) candidate.tests.push_back(tests[fact]);
    };
    std::ranges::for_each(task.conditions[snap], test);
    for (const FactId fact : task.invariants[task.snaps[snap].action]) {
      if (!task.is_derived[fact] && std::ranges::count(task.adds[snap], fact) == 0) test(fact);
    }
    std::ranges::sort(candidate.tests);
    candidate.tests.erase(std::unique(candidate.tests.begin(), candidate.tests.end()), candidate.tests.end());
    candidates.push_back(std::move(candidate));
  }
  // Two different values of one variable never hold together; such an action has no place in the tree.
  std::erase_if(candidates, [](const Candidate& candidate) {
    return std::ranges::adjacent_find(candidate.tests, {}, &Test::variable) != candidate.tests.end();
  });
  std::ranges::stable_sort(candidates, [](const Candidate& a, const Candidate& b) {
    return std::ranges::lexicographical_compare(a.tests, b.tests);
  });
  root_ = build(candidates, 0);
}

// Builds the tree below a node; the candidates agree on their first `depth` tests, and are sorted.
std::uint32_t SuccessorGenerator::build(std::span<Candidate> candidates, std::size_t depth) {
  if (candidates.empty()) return 0;
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const auto tested = std::ranges::find_if(
      candidates, [&](const Candidate& candidate) { return candidate.tests.size() > depth; });
  for (auto done = candidates.begin(); done != tested; ++done) nodes_[index].here.push_back(done->snap);
  if (tested == candidates.end()) return index;
  const std::uint32_t variable = tested->tests[depth].variable;
  nodes_[index].variable = variable;
  nodes_[index].by_value.assign(task_.layout.variables()[variable].facts.size() + 1, 0);
  auto begin = tested;
  while (begin != candidates.end() && begin->tests[depth].variable == variable) {
    const std::uint32_t value = begin->tests[depth].value;
    const auto end = std::find_if(begin, candidates.end(), [&](const Candidate& candidate) {
      return candidate.tests[depth].variable != variable || candidate.tests[depth].value != value;
    });
    const std::uint32_t child = build({begin, end}, depth + 1);
    nodes_[index].by_value[value] = child;
    begin = end;
  }
  const std::uint32_t rest = build({begin, candidates.end()}, depth);
  nodes_[index].otherwise = rest;
  return index;
}

void SuccessorGenerator::collect(StateView state, std::vector<SnapId>& result) const {
  if (root_ != 0) collect(root_, state, result);
}

void SuccessorGenerator::collect(std::uint32_t index, StateView state, std::vector<SnapId>& result) const {
  const Node& node = nodes_[index];
  result.insert(result.end(), node.here.begin(), node.here.end());
  if (node.by_value.empty()) return;
  const std::uint32_t child = node.by_value[task_.layout.value(state, node.variable)];
  if (child != 0) collect(child, state, result);
  if (node.otherwise != 0) collect(node.otherwise, state, result);
}

}  // namespace roci::planner::temporal_pddl::search
