#include "tests/engines/stepped/regression.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace roci::planner::proof {

using engine::Timelines;

namespace {

using Wanted = std::map<std::string, std::string>;  // value by timeline

constexpr std::size_t kMostNodes = 100'000;

struct RegressionNode {
  Wanted wanted;
  std::map<std::string, double> drawn;
  std::size_t after = 0;
  const Task* task = nullptr;
};

bool holds(const Wanted& wanted, const Timelines& state) {
  return std::ranges::all_of(wanted, [&](const auto& entry) {
    const auto found = state.find(entry.first);
    return found != state.end() && found->second == temporal::state(entry.second);
  });
}

// The timeline of which more is drawn than there is.
std::string overdrawn(const RegressionNode& node, const Timelines& state) {
  for (const auto& [timeline, amount] : node.drawn) {
    const auto found = state.find(timeline);
    const double* there = found == state.end() ? nullptr : std::get_if<double>(&found->second);
    if (there == nullptr || *there < amount) return timeline;
  }
  return "";
}

// What must hold before the task so that all that is wanted holds after it; nothing: the task is no help.
std::optional<RegressionNode> regress(const std::vector<RegressionNode>& nodes, std::size_t index,
                                      const Task& task) {
  const RegressionNode& node = nodes[index];
  bool helps = false;
  RegressionNode before{node.wanted, node.drawn, index, &task};
  for (const Held& held : task.sets) {
    const auto found = node.wanted.find(held.timeline);
    if (found == node.wanted.end()) continue;
    if (found->second != held.value) return std::nullopt;
    helps = true;
    before.wanted.erase(held.timeline);
  }
  if (!helps) return std::nullopt;
  for (const Held& held : task.needs) {
    const auto [entry, fresh] = before.wanted.emplace(held.timeline, held.value);
    if (!fresh && entry->second != held.value) return std::nullopt;
  }
  for (const Drawn& drawn : task.uses) before.drawn[drawn.timeline] += drawn.amount;
  return before;
}

bool can_be_set(const TaskModel& model, const Held& held) {
  return std::ranges::any_of(model.tasks,
                             [&](const Task& task) { return std::ranges::count(task.sets, held) > 0; });
}

}  // namespace

Chain chain_to(const TaskModel& model, const std::vector<Held>& wanted, const Timelines& state) {
  Chain out;
  for (const Held& held : wanted) {
    if (can_be_set(model, held) || holds({{held.timeline, held.value}}, state)) continue;
    out.timeline = held.timeline;
    out.reason = "no task makes it " + held.value;
    return out;
  }
  std::vector<RegressionNode> nodes(1);
  for (const Held& held : wanted) nodes[0].wanted[held.timeline] = held.value;
  std::set<std::pair<Wanted, std::map<std::string, double>>> seen;
  for (std::size_t i = 0; i < nodes.size() && nodes.size() < kMostNodes; ++i) {
    if (holds(nodes[i].wanted, state)) {
      for (std::size_t node = i; nodes[node].task != nullptr; node = nodes[node].after)
        out.tasks.push_back(nodes[node].task);
      return {out.tasks, true, "", ""};
    }
    for (const Task& task : model.tasks) {
      auto before = regress(nodes, i, task);
      if (!before) continue;
      const std::string scarce = overdrawn(*before, state);
      if (!scarce.empty()) {
        out.timeline = scarce;
      } else if (seen.emplace(before->wanted, before->drawn).second) {
        nodes.push_back(std::move(*before));
      }
    }
  }
  out.reason = out.timeline.empty() ? "no chain of tasks leads to it from here" : "there is too little of it";
  return out;
}

}  // namespace roci::planner::proof
