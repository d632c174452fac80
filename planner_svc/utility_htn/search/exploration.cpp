#include "planner_svc/utility_htn/search/exploration.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using temporal::RankVector, temporal::Time;

Exploration::Exploration(const Problem& problem, ChainTable& table, const Plan& fixed,
                         std::span<const std::uint32_t> batch)
    : problem_(problem),
      table_(table),
      fixed_(fixed),
      nodes_(table, problem.anchored, fixed.utility, fixed.cost) {
  if (problem.downlink) committed_ = table.committed_data();
  for (const std::uint32_t chain : batch) {
    if (!table.open(chain) || table.fixed(chain)) continue;
    if (table.contextual(chain)) {
      contextual_.push_back(chain);
    } else if (!refused(table.utility(chain))) {
      edges_.push_back({chain, table.utility(chain), per_cost(table.utility(chain), table.cost(chain))});
    }
  }
  std::ranges::sort(edges_, [this](const Prospect& a, const Prospect& b) { return comes_first(a, b); });
  find_prospects(0);
  enqueue(0);
}

bool Exploration::run(std::uint64_t entries, Statistics& statistics) {
  while (!queue_.empty()) {
    if (entries-- == 0 || bytes() >= kMostNodeBytes || (problem_.stop && problem_.stop())) return false;
    const Entry entry = queue_.top();
    queue_.pop();
    ++statistics.entries;
    nodes_.go_to(entry.node);
    enqueue(entry.node);
    extend(entry, statistics);
  }
  return true;
}

Plan Exploration::best() const {
  Plan out = fixed_;
  for (Placed& placed : nodes_.path(best_)) out.placed.push_back(std::move(placed));
  std::ranges::sort(out.placed, {},
                    [](const Placed& placed) { return std::pair(placed.starts.front(), placed.chain); });
  out.utility = nodes_[best_].utility;
  out.cost = nodes_[best_].cost;
  return out;
}

std::uint64_t Exploration::first_pairs() {
  const auto pays = [this](const Prospect& edge) { return affordable(nodes_[0], edge.chain); };
  return static_cast<std::uint64_t>(std::ranges::count_if(edges_, pays)) + nodes_[0].prospects.size();
}

std::size_t Exploration::bytes() const { return nodes_.bytes() + queue_.size() * (sizeof(Entry) + 128); }

bool Exploration::Later::operator()(const Entry& a, const Entry& b) const {
  const std::partial_ordering order = a.promise <=> b.promise;
  if (order != std::partial_ordering::equivalent) return order == std::partial_ordering::less;
  if (a.priority != b.priority) return a.priority < b.priority;
  return std::pair(a.node, a.chain) > std::pair(b.node, b.chain);
}

bool Exploration::affordable(const Node& node, std::uint32_t chain) const {
  return rounded(node.cost + table_.cost(chain)) < problem_.budget;
}

bool Exploration::comes_first(const Prospect& a, const Prospect& b) const {
  const std::partial_ordering order = a.ratio <=> b.ratio;
  if (order != std::partial_ordering::equivalent) return order == std::partial_ordering::greater;
  const std::int32_t priority_a = table_.request(a.chain).priority,
                     priority_b = table_.request(b.chain).priority;
  return priority_a != priority_b ? priority_a > priority_b : a.chain < b.chain;
}

// Asks the Assessor what contextual chains are worth after the plan here.
void Exploration::find_prospects(NodeId id) {
  if (contextual_.empty()) return;
  table_.follow(by_start(problem_.committed, all_placed(nullptr)));
  Node& node = nodes_[id];
  for (const std::uint32_t chain : contextual_) {
    if (nodes_.holds(table_.chain(chain).task) || !affordable(node, chain)) continue;
    RankVector utility = table_.forecast(chain);
    if (refused(utility)) continue;
    RankVector ratio = per_cost(utility, table_.cost(chain));
    node.prospects.push_back({chain, std::move(utility), std::move(ratio)});
  }
  node.prospects.shrink_to_fit();
  std::ranges::sort(node.prospects,
                    [this](const Prospect& a, const Prospect& b) { return comes_first(a, b); });
  nodes_.account(node);
}

// Puts the node, at which the timelines are, into the queue with the best chain that is left to it.
void Exploration::enqueue(NodeId id) {
  Node& node = nodes_[id];
  const auto passed = [&](const Prospect& edge) {
    return nodes_.holds(table_.chain(edge.chain).task) || !affordable(node, edge.chain);
  };
  while (node.next_edge < edges_.size() && passed(edges_[node.next_edge])) ++node.next_edge;
  const Prospect* edge = node.next_edge < edges_.size() ? &edges_[node.next_edge] : nullptr;
  const Prospect* prospect =
      node.next_prospect < node.prospects.size() ? &node.prospects[node.next_prospect] : nullptr;
  if (edge == nullptr && prospect == nullptr) return;
  const bool takes_edge = prospect == nullptr || (edge != nullptr && comes_first(*edge, *prospect));
  const Prospect& best = takes_edge ? *edge : *prospect;
  ++(takes_edge ? node.next_edge : node.next_prospect);
  queue_.push({node.utility + best.ratio, table_.request(best.chain).priority, id, best.chain, best.utility});
}

// Places the entry's chain after the plan here; where that can be done, a new node comes. Downlinks for which their sol
// has no energy left are tried in later ones.
void Exploration::extend(const Entry& entry, Statistics& statistics) {
  const std::size_t mark = problem_.anchored.mark();
  std::optional<Time> downlinks_from;
  Placed added;
  RankVector utility;
  for (int sols = 1;; ++sols) {
    std::optional<std::vector<Time>> starts = place(entry.chain, downlinks_from);
    if (!starts) {
      ++(downlinks_from ? statistics.without_downlink : statistics.unplaced);
      return;
    }
    added = {entry.chain, std::move(*starts)};
    std::uint64_t* lost = nullptr;
    if (nodes_.known(added)) {
      lost = &statistics.duplicates;
    } else if (!utility_of(added, entry, utility)) {
      lost = &statistics.broken_rules;
    } else if (problem_.downlink) {
      const PlannedData data = data_with(added);
      if (problem_.downlink(data)) break;
      downlinks_from = problem_.later && sols < kMostSols ? problem_.later(data) : std::nullopt;
      if (!downlinks_from) lost = &statistics.without_downlink;
    } else {
      break;
    }
    problem_.anchored.undo(mark);
    if (lost == nullptr) continue;
    ++*lost;
    return;
  }
  const double cost = rounded(nodes_[entry.node].cost + table_.cost(entry.chain));
  const NodeId id = nodes_.add(std::move(added), mark, cost, std::move(utility));
  ++statistics.nodes;
  const Node &node = nodes_[id], &best = nodes_[best_];
  if (node.utility > best.utility || (node.utility == best.utility && node.cost < best.cost)) best_ = id;
  find_prospects(id);
  enqueue(id);
}

// Sums up what the plan here brings with one chain more; false if that would break a rule of the mission.
bool Exploration::utility_of(const Placed& added, const Entry& entry, RankVector& out) const {
  const auto follows = [&](const Placed& placed) {
    return !table_.contextual(placed.chain) ||
           std::pair(placed.starts.front(), placed.chain) < std::pair(added.starts.front(), added.chain);
  };
  const std::vector<Placed> all = all_placed(&added);
  if (!table_.contextual(added.chain) ||
      (std::ranges::all_of(all, [&](const Placed& each) { return each == added || follows(each); }) &&
       std::ranges::all_of(problem_.committed, follows))) {
    out = rounded(nodes_[entry.node].utility + entry.utility);
    return true;
  }
  const std::vector<std::uint32_t> order = by_start(problem_.committed, all);
  std::vector<std::uint32_t> chosen;
  for (const Placed& placed : all) chosen.push_back(placed.chain);
  std::ranges::sort(chosen);
  RankVector sum;
  table_.follow({});
  for (const std::uint32_t chain : order) {
    if (std::ranges::binary_search(chosen, chain)) {  // otherwise it is committed
      const RankVector utility = table_.forecast(chain);
      if (refused(utility)) return false;
      sum += utility;
    }
    table_.follow_next(chain);
  }
  out = rounded(sum);
  return true;
}

PlannedData Exploration::data_with(const Placed& added) const {
  PlannedData out = committed_;
  for (const Placed& placed : all_placed(&added)) table_.add_data(placed, out);
  return out;
}

std::optional<std::vector<Time>> Exploration::place(std::uint32_t chain,
                                                    std::optional<Time> downlinks_from) const {
  const std::span<const Link> links = table_.links(chain);
  if (!downlinks_from) return problem_.scheduler.schedule(links, problem_.anchored);
  std::vector<Link> later(links.begin(), links.end());
  for (std::size_t i = 0; i < later.size(); ++i)
    if (problem_.network.tasks[table_.chain(chain).links[i].task].downlinks)
      later[i].starts.earliest = std::max(later[i].starts.earliest, *downlinks_from);
  return problem_.scheduler.schedule(later, problem_.anchored);
}

// Lists what is held fixed, the plan here, and perhaps one chain more.
std::vector<Placed> Exploration::all_placed(const Placed* added) const {
  std::vector<Placed> out = fixed_.placed;
  out.insert(out.end(), nodes_.here().begin(), nodes_.here().end());
  if (added != nullptr) out.push_back(*added);
  return out;
}

}  // namespace roci::planner::utility_htn::search
