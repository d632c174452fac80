// The relaxation is the relaxed problem that is followed to prove that there is no plan
// (relaxed_reachability.hpp).
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/timeline_htn/search/last_states.hpp"
#include "planner_svc/timeline_htn/search/relaxed_reachability.hpp"
#include "planner_svc/timeline_htn/search/successors.hpp"
#include "planner_svc/timeline_htn/search/transition_graph.hpp"

namespace roci::planner::timeline_htn::search {

/// Follows what timelines come to, complex states are made of and behaviours ask for, until nothing is added;
/// leaves out what is in no plan, and follows it all again.
class Relaxation {
 public:
  Relaxation(const model::Model& model, std::size_t most_bytes, const std::function<bool()>& cancelled);

  /// Returns what is never reached, or nothing: then there may be a plan, or it gave up. To be called once.
  std::optional<NeverReached> run();

 private:
  /// Describes one behaviour with its objects. Objects that neither parts nor conditions hold are left open.
  struct Way {
    Index behaviour = 0;
    std::vector<Index> objects;
    std::vector<StateId> parts;
    bool left_out = false;
    bool begun = false;
  };
  /// Holds a complex state below states of these components, or a behaviour that is triggered.
  struct Task {
    StateId state = kNone;
    ComponentSet above = 0;
    std::vector<Way> ways;
    bool known = false;  ///< its ways
    bool done = false;
    bool asked = true;  ///< for the goals, where errors are mended before
  };
  /// Holds a group of states that are asked for and that the same states lead to.
  struct Wish {
    Index part = 0;  // of the transition graph
    bool by_complex = true;
    ComponentSet above = 0;
    StateId only = kNone;
    bool also_from_itself = false;
  };
  struct Timeline {
    StateId initial = kNone;
    bool predicted = false;
    std::vector<StateId> known;  // that are predicted, with the initial one
    std::optional<TransitionGraph> graph;
    std::vector<StateId> reached;
    std::vector<StateId> earlier;  // reached while errors are mended
    std::vector<Wish> wishes;
    Index changes = 0;  // of the wishes
  };
  struct Mark {
    bool reached = false;
    bool earlier = false;  // reached while errors are mended
    // Complex, complete before the goals begin: it may be left, its parts come about no more.
    bool over = false;
    bool done = false;      // of a complex state
    bool left_out = false;  // in no plan
    bool left = false;      // what follows without a wish was added
    Index changes = 0;      // of the wishes that were followed
  };

  // relaxation.cpp: the rounds, and the goals once more behind what mends errors
  void start(bool with_goals = true);
  void ask_for_goals();
  void forget_tasks(std::size_t first, bool asked);
  bool start_mended();
  std::optional<std::vector<StateId>> left_by_mending(LastStates& last, Index component);
  bool leave_out();
  const model::Need* unmet_need(StateId state) const;
  std::size_t bytes() const;

  // relaxation_timelines.cpp: where timelines come
  const TransitionGraph& graph(Index component);
  bool propagate();
  bool reach(StateId state);
  void wish(StateId state, bool by_complex, ComponentSet above);
  bool is_left_for_another(StateId state) const;
  bool go_on(Timeline& timeline, StateId from);
  bool go_on_by_itself(StateId from);

  // relaxation_tasks.cpp: which behaviours begin, and which come about
  bool add_task(StateId state, ComponentSet above);
  void ask_for(StateId state, ComponentSet above);
  void add_way(Task& task, Index index, const std::vector<Index>& objects);
  ComponentSet below(const Task& task) const;
  void find_ways(Task& task);
  bool fits(const model::Precondition& condition, const std::vector<Index>& objects) const;
  bool begins(StateId state, ComponentSet above);
  bool is_done(StateId part, ComponentSet above);
  bool carry_out(std::size_t index);

  // relaxation_reasons.cpp: what is said of it
  std::optional<NeverReached> unmet();
  std::string only_comes_to(Index component) const;
  std::string reason_of(const Task& task);
  std::string reason_of(StateId state, ComponentSet above);
  static std::vector<model::Variable> scope_of(const model::State& state);

  Mark& mark(StateId state) {
    if (state >= marks_.size()) marks_.resize(state + 1);
    return marks_[state];
  }
  Index component(StateId state) const { return ground_.at(state).state.component; }
  model::StateKind kind(StateId state) const { return ground_.at(state).kind; }
  bool is_complex(StateId state) const { return kind(state) == model::StateKind::complex; }
  static ComponentSet bit(Index component) { return ComponentSet{1} << component; }

  const model::Model& model_;
  std::size_t most_bytes_;
  const std::function<bool()>& cancelled_;
  Ground ground_;
  Bindings bindings_;
  Successors successors_;
  std::set<std::pair<Index, Index>> left_for_another_;  // states to rest in that a need may end
  std::vector<Timeline> timelines_;
  std::vector<Mark> marks_;
  std::vector<Task> tasks_;  // what is triggered first
  std::map<std::pair<StateId, ComponentSet>, std::size_t> task_of_;
  std::set<std::pair<Index, std::vector<Index>>> task_ways_;  // of the task whose ways are found
  std::size_t causes_ = 0;
  std::size_t steps_ = 0;
  std::size_t way_bytes_ = 0;
  std::set<std::pair<StateId, ComponentSet>> explained_;
};

}  // namespace roci::planner::timeline_htn::search
