#include "planner_svc/temporal_pddl/search/successor_generator.hpp"

#include <algorithm>
#include <optional>
#include <span>

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
  build(candidates);
}

// Builds the tree, whose depth is the number of variables: what is still to be built stands on a stack of its
// own, the last one first, so that nodes lie in memory as collect() meets them.
void SuccessorGenerator::build(std::span<Candidate> all) {
  struct Subtree {
    std::span<Candidate> candidates;  // they agree on their first `depth` tests, and are sorted
    std::size_t depth = 0;
    std::uint32_t parent = 0;
    std::optional<std::uint32_t> value;  // whose child of the parent it is; none: of those that do not test
  };
  std::vector<Subtree> open{{all, 0, 0, std::nullopt}};
  while (!open.empty()) {
    const auto [candidates, depth, parent, of_value] = open.back();
    open.pop_back();
    if (candidates.empty()) continue;
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    (of_value ? nodes_[parent].by_value[*of_value] : nodes_[parent].otherwise) = index;
    const auto tested = std::ranges::find_if(
        candidates, [depth = depth](const Candidate& candidate) { return candidate.tests.size() > depth; });
    for (auto done = candidates.begin(); done != tested; ++done) nodes_[index].here.push_back(done->snap);
    if (tested == candidates.end()) continue;
    const std::uint32_t variable = tested->tests[depth].variable;
    nodes_[index].variable = variable;
    nodes_[index].by_value.assign(task_.layout.variables()[variable].facts.size() + 1, 0);
    const std::size_t first_child = open.size();
    auto begin = tested;
    while (begin != candidates.end() && begin->tests[depth].variable == variable) {
      const std::uint32_t value = begin->tests[depth].value;
      const auto end = std::find_if(begin, candidates.end(), [&, depth = depth](const Candidate& candidate) {
        return candidate.tests[depth].variable != variable || candidate.tests[depth].value != value;
      });
      open.push_back({{begin, end}, depth + 1, index, value});
      begin = end;
    }
    open.push_back({{begin, candidates.end()}, depth, index, std::nullopt});
    std::reverse(open.begin() + static_cast<std::ptrdiff_t>(first_child), open.end());
  }
}

void SuccessorGenerator::collect(StateView state, std::vector<SnapId>& result) const {
  std::vector<std::uint32_t> later;  // subtrees whose turn comes when the one before them is done
  std::uint32_t index = nodes_.front().otherwise;
  while (index != 0) {
    const Node& node = nodes_[index];
    result.insert(result.end(), node.here.begin(), node.here.end());
    index = node.otherwise;
    if (!node.by_value.empty()) {
      const std::uint32_t child = node.by_value[task_.layout.value(state, node.variable)];
      if (child != 0 && index != 0) later.push_back(index);
      if (child != 0) index = child;
    }
    if (index == 0 && !later.empty()) {
      index = later.back();
      later.pop_back();
    }
  }
}

}  // namespace roci::planner::temporal_pddl::search
