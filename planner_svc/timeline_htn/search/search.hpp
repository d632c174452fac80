// The search of the hierarchical timeline engine goes forward in time from the initial state (R133), and
// builds and keeps the hierarchy (R130).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "planner_svc/timeline_htn/search/partial_plan.hpp"
#include "planner_svc/timeline_htn/search/relaxed_reachability.hpp"
#include "planner_svc/timeline_htn/search/successors.hpp"

namespace roci::planner::timeline_htn::search {

/// Names what estimates how much is left to do.
enum class Heuristic { blind, relaxed_plan, landmarks };

/// Describes one way to search; ways differ in what they try first.
struct Resolver {
  Heuristic heuristic = Heuristic::blind;
  Order order = Order::first_declared;
  friend bool operator==(const Resolver&, const Resolver&) = default;
};

/// Says how far a search has come.
enum class Outcome {
  searching,
  solved,
  exhausted,  ///< there is no plan, as far as the search is complete (see Search)
  out_of_memory,
  cancelled,
};

/// Counts what a search did, and what it keeps.
struct Count {
  std::uint64_t expanded = 0;   ///< plans of which the steps were looked at
  std::uint64_t evaluated = 0;  ///< steps that were tried
  std::uint64_t refused = 0;    ///< of these: that led nowhere
  std::uint64_t repeated = 0;   ///< of these: to where the search had been
  std::size_t nodes = 0;        ///< that are kept
  std::size_t bytes = 0;        ///< of nodes, plan and ground states
};

/// Estimates how much is left to do.
class Estimate {
 public:
  virtual ~Estimate() = default;
  virtual std::uint32_t of(const PartialPlan& plan) = 0;
};
std::unique_ptr<Estimate> make_estimate(Heuristic heuristic, Ground& ground, const Successors& successors);

/// Returns the goals in the order in which they are tried: what comes first by `after`, then what closes or opens
/// first, then the first in the problem.
std::vector<Index> goal_order(const model::Problem& problem);

/// Runs a greedy best-first search with deferred evaluation; blind it is depth-first. It is resumable, and the
/// same model, resolver and budgets give the same steps.
///
/// It searches in up to five passes, each of which finds more and takes longer. The first goes straight from state to
/// state of a timeline, and drops a plan whose timelines and open activities are those of one that was seen, whatever
/// its times. The second takes detours, and lets timelines go to rest in any order. Where time has refused a step,
/// what was dropped may be missed, so the third drops nothing. Where time refuses steps still, the fourth lets a
/// timeline also leave a state that is wanted and come back to it, so that what is placed later finds it ended, or
/// another one in between; and the fifth drops nothing of that. These two take about as many steps as those before,
/// since plans that need such rounds are rare and proofs without them are not. So it is complete but for such rounds,
/// as far as the ancestors of a complex state do not hold that state again.
///
/// Before it takes detours, or where the first pass takes long,
/// it looks once whether a relaxed reachability proves that there is no plan.
class Search {
 public:
  Search(const model::Model& model, const Resolver& resolver);

  /// Goes on until it is solved or exhausted, or so many steps were tried in all.
  Outcome run(std::uint64_t evaluations, std::size_t memory_bytes, const std::function<bool()>& cancelled);
  /// Lets only the search itself prove anything from now on, so that the relaxed reachability can be compared
  /// with it.
  void prove_by_search_alone() { looked_at_ = true; }
  Outcome state() const { return state_; }
  const Count& count() const { return count_; }
  /// Returns, with solved, the plan that was found.
  const PartialPlan& plan() const { return *plan_; }
  const Ground& ground() const { return ground_; }
  const Bindings& bindings() const { return bindings_; }
  /// Returns, with exhausted, what the search that came farthest met, in words.
  std::string reason() const;
  /// Returns the goal of which reason() speaks; kNone: none in particular.
  Index blocking_goal() const;

 private:
  struct Node {
    Index parent;
    Index depth;
    Step step;
  };
  void start();
  // A goal that no timeline can come to, since behaviours with the objects that there are make up nothing before it.
  std::optional<Obstacle> out_of_reach();
  // Whether it is proved that no pass finds a plan. It is looked at once.
  bool is_hopeless(std::size_t memory_bytes, const std::function<bool()>& cancelled);
  bool drops_nothing() const;
  int pass_to_come() const;
  // Whether a step takes a later time of a predicted state, and time was in the way of nothing behind the first one.
  bool is_later_for_nothing(const Node& node) const;
  void next_pass();
  bool go_to(Index node);
  void expand(Index node);
  bool is_predicted(Index token) const;
  std::uint64_t signature() const;
  void note(const Obstacle& obstacle);
  std::string reason_of_window(const Obstacle& obstacle) const;
  std::size_t bytes() const;

  Ground ground_;
  Bindings bindings_;
  Successors successors_;
  std::vector<Index> goals_;
  std::unique_ptr<Estimate> estimate_;
  std::unique_ptr<PartialPlan> plan_;
  std::vector<Node> nodes_;
  std::map<std::uint32_t, std::vector<Index>> open_;
  std::unordered_set<std::uint64_t> seen_;
  struct Windows {
    Index first;  // token
    std::size_t refusals;
  };
  std::unordered_map<Index, Windows> windows_;  // by the node that chooses among them
  std::vector<Index> path_;                     // nodes from the root to where the plan is
  std::vector<PartialPlan::Mark> marks_;
  std::vector<Step> steps_;
  Obstacle obstacle_;
  std::optional<std::pair<StateId, Duration>>
      waited_for_;  // the last predicted state that was, and its start
  std::optional<NeverReached> never_reached_;
  bool looked_at_ = false;  // whether the relaxed reachability was
  std::size_t farthest_ = 0;
  int pass_ = 0;
  std::uint64_t repeated_before_ = 0;  // this pass
  std::uint64_t rounds_until_ = 0;     // steps in all
  Outcome state_ = Outcome::searching;
  Count count_;
};

}  // namespace roci::planner::timeline_htn::search
