// The node store keeps partial plans as compact nodes: each holds one chain with its starts and the plan that
// it extends.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/search/chain_table.hpp"

namespace roci::planner::utility_htn::search {

using NodeId = std::uint32_t;

/// Holds a chain that a node may be extended with, and what it is worth there.
struct Prospect {
  std::uint32_t chain = 0;
  temporal::RankVector utility{};
  temporal::RankVector ratio{};
};

/// Holds a partial plan: its parent's, and one chain more.
struct Node {
  NodeId parent = 0;
  std::uint32_t depth = 0;
  std::uint32_t chain = 0;
  std::uint32_t starts = 0;  ///< where those of its links begin
  double cost = 0;
  temporal::RankVector utility{};
  std::uint64_t key = 0;              ///< of all placements on the path, whatever their order
  std::vector<Prospect> prospects{};  ///< contextual ones, the best first
  std::uint32_t next_prospect = 0;    ///< the first that has not been taken
  std::uint32_t next_edge = 0;        ///< likewise among those that are not contextual, which all nodes share
};

/// Holds all nodes of a batch, and keeps the timelines at one of them: from node to node only what the two do not share
/// is taken back and placed.
class NodeStore {
 public:
  /// Begins with the root, the plan that stands on the timelines.
  NodeStore(ChainTable& table, temporal::timelines::Timelines& timelines, temporal::RankVector utility,
            double cost);
  NodeStore(const NodeStore&) = delete;
  NodeStore& operator=(const NodeStore&) = delete;
  /// Leaves the timelines as they were.
  ~NodeStore();

  Node& operator[](NodeId id) { return nodes_[id]; }
  const Node& operator[](NodeId id) const { return nodes_[id]; }
  std::size_t size() const { return nodes_.size(); }

  /// Brings the timelines to the node's plan.
  void go_to(NodeId id);
  /// Returns the chains of the node at which the timelines are, in the order in which they were added.
  std::span<const Placed> here() const { return placed_; }
  /// Returns whether the plan there holds the request.
  bool holds(model::TaskIndex request) const { return taken_[request]; }

  /// Returns whether a node has the same chains at the same times as the plan here with one more.
  bool known(const Placed& added) const;
  /// Adds a node below the one here, whose chain already stands on the timelines since `mark`, and is then there.
  NodeId add(Placed added, std::size_t mark, double cost, temporal::RankVector utility);

  std::vector<Placed> path(NodeId id) const;
  std::size_t bytes() const;
  /// Takes in what a node's prospects take.
  void account(const Node& node);

 private:
  Placed placed(const Node& node) const;
  void enter(NodeId id, Placed placed, std::size_t mark);
  void leave();

  ChainTable& table_;
  temporal::timelines::Timelines& timelines_;
  std::size_t begin_;
  std::vector<Node> nodes_;
  std::vector<temporal::Time> starts_;
  std::unordered_multimap<std::uint64_t, NodeId> by_key_;
  std::size_t extra_bytes_ = 0;

  std::vector<NodeId> here_;  // from the first below the root
  std::vector<Placed> placed_;
  std::vector<std::size_t> marks_;
  std::vector<bool> taken_;  // by task
};

}  // namespace roci::planner::utility_htn::search
