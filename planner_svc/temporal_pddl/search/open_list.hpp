// In an open list, successors wait to be tried in several queues that take turns; the preferred ones are
// served first as long as that leads on (Helmert 2006, section 6; Richter and Helmert 2009; Röger and Helmert
// 2010).
//
// The successors of a state wait together: each queue holds one run of them, and all share one list, in which
// is noted what has been tried. The list goes when no queue needs it any more.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/search/ranked_queue.hpp"
#include "planner_svc/temporal_pddl/search/state_store.hpp"

namespace roci::planner::temporal_pddl::search {

/// Names a successor that has not been built yet.
struct OpenEntry {
  NodeId parent;
  task::SnapId snap;
};

/// Holds the ranks by which the successors of a state wait, one for each kind of queue.
struct Ranks {
  Priority by_plan, by_landmarks, by_novelty;
};

/// Holds the successors that wait, and counts its bytes.
class OpenList {
 public:
  /// Says which queues there are beside those by the estimate of the plan. Without any, each successor waits
  /// in one queue, among the preferred or the others; else it waits in a queue of each kind, and the
  /// preferred among all.
  struct Kinds {
    bool by_landmarks = false;
    bool by_novelty = false;
  };

  explicit OpenList(Kinds kinds);

  /// Adds the successors of `parent`, of which none waits yet; `preferred` is sorted.
  void push(const Ranks& ranks, NodeId parent, std::span<const task::SnapId> successors,
            std::span<const task::SnapId> preferred);
  /// Takes an entry from the queue that was served least. Each entry comes once; where it waits in several
  /// queues, its turn in the others passes.
  std::optional<OpenEntry> pop();
  /// Takes in that the search has made progress: what is preferred is served first for a while.
  void boost();

  std::size_t bytes() const;

 private:
  static constexpr std::int64_t kBoost = 1000;

  // Says which of equally good runs comes first. With `streaks` it is for a while the youngest, which goes on
  // with the plan at hand, then for as long the oldest, which goes back to where there was a choice.
  enum class Order { oldest, streaks };
  struct Successor {
    std::uint32_t snap : 30;
    std::uint32_t preferred : 1;
    std::uint32_t tried : 1;
  };
  // Holds the successors of one state.
  struct Successors {
    std::unique_ptr<Successor[]> list;
    std::uint32_t size = 0;
    std::uint32_t runs = 0;  // in how many queues some of them wait
  };
  // Names positions in the list of a parent's successors. The first and the last one wait in the run's queue.
  struct Run {
    NodeId parent;
    std::uint32_t begin = 0, end = 0;
  };
  struct Queue {
    bool preferred;
    Priority Ranks::*rank;
    Order order;
    std::int64_t served = 0;
    RankedQueue<Run> runs = {};
  };

  static std::size_t bytes(const Successors& successors);
  bool waits(const Queue& queue, Successor successor) const;
  void trim(const Queue& queue, Run& run) const;
  std::optional<OpenEntry> serve(Queue& queue);
  void release(NodeId parent);

  std::vector<Queue> queues_;
  std::vector<Successors> successors_;  // by parent
  std::size_t list_bytes_ = 0;          // of all lists
};

}  // namespace roci::planner::temporal_pddl::search
