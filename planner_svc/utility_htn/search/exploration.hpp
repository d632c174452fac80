// This is the exploration of one batch (MEXEC, section III.A, algorithm 1).
#pragma once

#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "planner_svc/utility_htn/search/chain_table.hpp"
#include "planner_svc/utility_htn/search/node_store.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Explores partial plans that extend what is held fixed by chains of one batch.
///
/// The queue of algorithm 1 holds each node with each chain that may extend it. Here each node waits once, with the
/// best of the chains that are left to it; when that is taken, the node waits with its next.
/// The order in which pairs are taken is the same.
class Exploration {
 public:
  /// Takes what is held fixed, which stands on the timelines, and the chains of the batch.
  Exploration(const Problem& problem, ChainTable& table, const Plan& fixed,
              std::span<const std::uint32_t> batch);

  /// Takes at most so many pairs from the queue. Returns whether it ran empty.
  bool run(std::uint64_t entries, Statistics& statistics);
  /// Returns the best plan so far; what is held fixed is part of it.
  Plan best() const;
  /// Returns with how many chains the empty plan may be extended.
  std::uint64_t first_pairs();
  std::size_t bytes() const;

 private:
  struct Entry {
    temporal::RankVector promise{};  // P.utility + T.utility / T.cost
    std::int32_t priority = 0;
    NodeId node = 0;
    std::uint32_t chain = 0;
    temporal::RankVector utility{};  // of the chain after all that is planned
  };
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const;
  };

  bool affordable(const Node& node, std::uint32_t chain) const;
  bool comes_first(const Prospect& a, const Prospect& b) const;
  void find_prospects(NodeId id);
  void enqueue(NodeId id);
  void extend(const Entry& entry, Statistics& statistics);
  std::optional<std::vector<temporal::Time>> place(std::uint32_t chain,
                                                   std::optional<temporal::Time> downlinks_from) const;
  PlannedData data_with(const Placed& added) const;
  bool utility_of(const Placed& added, const Entry& entry, temporal::RankVector& out) const;
  std::vector<Placed> all_placed(const Placed* added) const;

  const Problem& problem_;
  PlannedData committed_;  // which no candidate changes
  ChainTable& table_;
  const Plan& fixed_;
  std::vector<Prospect> edges_;            // not contextual, the best first
  std::vector<std::uint32_t> contextual_;  // chains
  NodeStore nodes_;
  NodeId best_ = 0;
  std::priority_queue<Entry, std::vector<Entry>, Later> queue_;
};

}  // namespace roci::planner::utility_htn::search
