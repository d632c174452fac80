// Successors say what may be done next with a plan that is being built.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "planner_svc/timeline_htn/search/partial_plan.hpp"

namespace roci::planner::timeline_htn::search {

/// Says which of several equally good steps comes first.
enum class Order { first_declared, last_declared };

class Decompositions;

/// Gives the steps that lead on from a plan, so that every plan that there is can still be reached.
///
/// What is urgent is settled at once: the parts of a complex state, then what a value needs of others. Else the open
/// activity that may start the earliest is placed, its value at the end of its timeline: the search goes forward in
/// time (R133). Others stand beside it as alternatives only where they might touch the same components, now or through
/// what they bring about; the order of those that do not makes no difference.
class Successors {
 public:
  Successors(Ground& ground, Bindings& bindings, Order order);
  ~Successors();

  /// Writes the steps in the order in which they are to be tried. There are none at a dead end, or if the
  /// plan is whole.
  void of(const PartialPlan& plan, std::vector<Step>& out);
  /// Returns whether nothing is left to do but to let the timelines end.
  static bool whole(const PartialPlan& plan, const Ground& ground);
  /// Lets a timeline take a longer way to a state than the shortest, from now on.
  void permit_detours() { detours_ = true; }
  /// Returns whether there were longer ways that were not given.
  bool left_out() const { return left_out_; }
  /// Lets a timeline leave a wanted state and come back to it, from now on.
  void permit_rounds() { rounds_ = true; }
  /// Returns whether there were such ways that were not given.
  bool round_left_out() const { return round_left_out_; }
  /// Returns whether predicted states were not given since they end before what needs them can begin,
  /// by the times of the plan.
  bool passed_by() const { return passed_by_; }
  /// Tells why there was no step.
  const Obstacle& obstacle() const { return obstacle_; }
  /// Returns the behaviours for a complex state, the first to be tried first.
  const std::vector<Index>& behaviours(Index component, Index state) const;
  /// Returns the bindings of a behaviour's variables with which it achieves the state.
  std::vector<std::vector<Index>> ways(Index behaviour, StateId state) const;
  /// Returns what complex states can be made of, whatever the timelines.
  Decompositions& below() const { return *below_; }

 private:
  void urgent(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out);
  void decompositions(const PartialPlan& plan, Index activity, std::vector<Step>& out);
  // Whether a recursion through the parts of a behaviour can end without the states that they are to stand below.
  bool recursion_can_end(const PartialPlan& plan, Index activity, Index behaviour,
                         const std::vector<Index>& objects);
  void needs(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out);
  void conditions(const PartialPlan& plan, const Urgent& item, std::vector<Step>& out);
  std::vector<Index> still_to_come(const PartialPlan& plan, Index component, TimePoint point);
  void place(const PartialPlan& plan, Index activity, std::vector<Step>& out);
  void attach_back(const PartialPlan& plan, Index activity, std::vector<Step>& out);
  void rest(const PartialPlan& plan, std::vector<Step>& out);
  std::vector<Index> candidates(const PartialPlan& plan);
  // Successors from which the goal can be reached, the nearest first.
  std::vector<StateId> towards(const PartialPlan& plan, Index component, StateId goal, Index path_from,
                               bool complex_permitted);
  bool may_go_round(Index component);
  bool may_pass(const PartialPlan& plan, StateId goal, Index path_from, const std::vector<StateId>& states);

  Ground* ground_;
  Bindings* bindings_;
  Order order_;
  std::map<std::pair<Index, Index>, std::vector<Index>> behaviours_;
  std::unique_ptr<Decompositions> below_;
  bool detours_ = false;
  bool left_out_ = false;
  bool rounds_ = false;
  bool round_left_out_ = false;
  bool passed_by_ = false;
  Obstacle obstacle_;
};

}  // namespace roci::planner::timeline_htn::search
