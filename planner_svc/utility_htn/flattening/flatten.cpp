#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/hierarchy.hpp"

namespace roci::planner::utility_htn::flattening {

using model::Decomposition, model::Network, model::Subtask, model::Task, model::TaskIndex;

namespace {

// A chain that has not got the name of its task yet.
struct Piece {
  std::string name;  // "/first/raw"
  std::vector<Subtask> links;
  std::vector<temporal::timelines::Constraint> when;
};

class Flattener {
 public:
  explicit Flattener(const Network& network) : network_(network) {}

  std::vector<Piece> pieces(TaskIndex index) {
    const Task& task = network_.tasks[index];
    if (task.primitive()) return {{"", {{index, temporal::Duration{0}, temporal::no_bound}}, {}}};
    std::vector<Piece> out;
    for (const Decomposition& decomposition : task.decompositions) {
      std::vector<Piece> begun{{"/" + decomposition.name, {}, decomposition.when}};
      for (const Subtask& subtask : decomposition.subtasks) begun = each_with(begun, subtask);
      std::ranges::move(begun, std::back_inserter(out));
    }
    return out;
  }

 private:
  // Each begun piece followed by each way to do the subtask; the later choice changes faster.
  std::vector<Piece> each_with(const std::vector<Piece>& begun, const Subtask& subtask) {
    std::vector<Piece> ways = pieces(subtask.task);
    for (Piece& way : ways) {
      way.links.front().shortest_gap = subtask.shortest_gap;
      way.links.front().longest_gap = subtask.longest_gap;
    }
    std::vector<Piece> out;
    out.reserve(begun.size() * ways.size());
    for (const Piece& head : begun) {
      for (const Piece& way : ways) {
        Piece& piece = out.emplace_back(head);
        piece.name += way.name;
        piece.links.insert(piece.links.end(), way.links.begin(), way.links.end());
        piece.when.insert(piece.when.end(), way.when.begin(), way.when.end());
      }
    }
    return out;
  }

  const Network& network_;
};

}  // namespace

Chains flatten(const Network& network) { return flatten(network, {}); }

Chains flatten_all(const Network& network) { return flatten(network, templates_on_call(network)); }

std::set<TaskIndex> templates_on_call(const Network& network) {
  std::set<TaskIndex> out;
  for (const Task& task : network.tasks)
    if (task.contingency)
      for (const TaskIndex request : task.contingency->requests)
        if (network.tasks[request].is_template) out.insert(request);
  return out;
}

Chains flatten(const Network& network, const std::set<TaskIndex>& templates) {
  Chains out;
  out.by_batch.resize(std::max<std::size_t>(1, network.batches.size()));
  const std::vector<model::Extent> extents = model::measure(network).extents;
  if (extents.size() != network.tasks.size())
    throw std::invalid_argument("a task is a part of itself; check the network before it is flattened");
  Flattener flattener(network);
  for (TaskIndex index = 0; index < network.tasks.size(); ++index) {
    const Task& task = network.tasks[index];
    if (task.is_template && !templates.contains(index)) continue;
    if (extents[index].chains > kMostChains)
      throw std::invalid_argument(
          "task '" + task.id + "' has more than " + std::to_string(kMostChains) +
          " chains: the numbers of decompositions of its subtasks multiply; split it into "
          "tasks of their own");
    for (Piece& piece : flattener.pieces(index)) {
      out.by_batch.at(task.batch).push_back(static_cast<std::uint32_t>(out.chains.size()));
      out.chains.push_back({index, task.id + piece.name, std::move(piece.links), std::move(piece.when)});
    }
  }
  return out;
}

temporal::timelines::Footprint footprint(const Network& network, const Chain& chain, std::size_t link,
                                         const model::Values& values) {
  temporal::timelines::Footprint out = model::footprint(network.tasks[chain.links[link].task], values);
  if (link > 0) return out;
  for (temporal::timelines::Constraint constraint : chain.when) {
    constraint.phase = temporal::timelines::Phase::pre;
    out.constraints.push_back(constraint);
  }
  return out;
}

double cost(const Network& network, const Chain& chain, const model::Values& values) {
  double sum = 0;
  for (const Subtask& link : chain.links) sum += model::cost(network, network.tasks[link.task], values);
  return sum;
}

temporal::RankVector utility(const Network& network, const Chain& chain, const model::Values& values) {
  temporal::RankVector sum;
  for (const Subtask& link : chain.links) sum += model::utility(network.tasks[link.task], values);
  return sum;
}

}  // namespace roci::planner::utility_htn::flattening
