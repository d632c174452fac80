// A partial plan is a plan while it is built: timelines that grow at their ends, the hierarchy above them,
// what is still to be done, and time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/timeline_htn/search/bindings.hpp"
#include "planner_svc/timeline_htn/search/ground.hpp"
#include "planner_svc/timeline_htn/search/network.hpp"

namespace roci::planner::timeline_htn::search {

/// Holds a value of a timeline. Its start is the end of the one before.
struct Token {
  StateId state = kNone;
  TimePoint start = 0;
  TimePoint end = 0;
  Index activity = kNone;  ///< whose state it is; kNone: one to rest in, or where the timeline began
  Index before = kNone;    ///< token of the same timeline
  Index cause = kNone;     ///< activity for which it was appended; kNone: none, or where the timeline began
  Index ended = 0;         ///< 1: something asks for its end before the horizon
  /// Says whether it belongs to what mends an error, or to what its timeline goes on with at once: neither
  /// waits for the mending.
  bool mends = false;
};

/// Holds a node of the hierarchy: a subgoal, a goal, a step between two states, or a behaviour that mends an
/// error.
struct Activity {
  StateId state = kNone;  ///< kNone: of a behaviour that was triggered
  Index parent = kNone;
  TimePoint start = 0;
  TimePoint end = 0;
  model::Bounds bounds;
  Index goal = kNone;  ///< of the problem
  /// Numbers the subgoal of the parent's behaviour; kNone: a goal, or a step that transitions or needs ask
  /// for.
  Index subgoal = kNone;
  Index behaviour = kNone;  ///< that was chosen for a complex state
  Index binding = kNone;    ///< of its variables
  Index token = kNone;      ///< kNone: not placed, or within a state of the same timeline
  Index open_parts = 0;     ///< of a complex state: parts that are not complete
  Index path_from = kNone;  ///< number of tokens when the path to its state began
  Index before_begin = 0;   ///< activities that end before it starts, in PartialPlan::before()
  Index before_end = 0;
  bool placed = false;
  bool nested = false;   ///< within a state of its own timeline
  bool beside = false;   ///< of a choice that the plan does not reckon with
  Index choice = kNone;  ///< of a decision over a variable, beside: the object that it stands for
};

/// Says what kind of thing must be settled before anything else.
enum class UrgentKind : std::uint8_t { decompose, need, path_to_need, condition };

/// Holds one thing that must be settled before anything else, on a stack of such.
struct Urgent {
  UrgentKind kind = UrgentKind::decompose;
  Index subject = 0;     ///< activity, or token that needs
  Index need = 0;        ///< or condition of the activity's behaviour, of a timeline that is predicted
  StateId goal = kNone;  ///< of a path
  Index path_from = 0;
  Index below = kNone;  ///< the next urgent one
};

/// Says what one step of the search does.
enum class StepKind : std::uint8_t {
  attach,
  append,
  pass,  ///< append the wanted state as one on the way, to come again
  nest,
  decompose,
  need_here,
  need_path,
  path_to_need,
  pass_to_need,
  rest,
  condition_here
};

/// Holds one step of the search.
struct Step {
  StepKind kind = StepKind::attach;
  Index subject = 0;  ///< activity, token or component
  Index first = 0;    ///< state, behaviour or token
  Index second = 0;   ///< binding, need or condition
  friend bool operator==(const Step&, const Step&) = default;
};

/// Says why a step could not be taken.
struct Obstacle {
  enum class Kind {
    none,
    time,
    condition,
    no_behaviour,
    no_path,
    no_state,
    recursion,
    need,
    window  ///< no time is left at which a timeline is predicted to be as it must
  } kind = Kind::none;
  Index goal = kNone;
  StateId state = kNone;  ///< that was wanted
  Index behaviour = kNone;
  Index condition = kNone;
  StateId at = kNone;  ///< where the timeline stood
};

/// Holds a plan that is changed by steps and taken back step by step: what a step costs is what it changes.
class PartialPlan {
 public:
  /// The problem must be there and checked. Goals stand in the order in which they are to be tried.
  PartialPlan(Ground& ground, Bindings& bindings, const std::vector<Index>& goal_order);

  /// Returns whether the goals' windows and order permit any plan.
  bool sound() const { return sound_; }

  struct Mark {
    Network::Mark network;
    std::size_t tokens, activities, urgent, before, changes;
  };
  Mark mark() const;
  void take_back(const Mark& mark);
  /// Takes the step. Returns false where it leads nowhere; then the plan must be taken back.
  bool take(const Step& step);

  const std::vector<Token>& tokens() const { return tokens_; }
  const std::vector<Activity>& activities() const { return activities_; }
  /// Returns the last value of a timeline.
  Index current(Index component) const { return current_[component]; }
  /// Returns the first one.
  Index begun(Index component) const { return begun_[component]; }
  StateId current_state(Index component) const { return tokens_[current_[component]].state; }
  /// Returns the activities that are still to be placed.
  const std::vector<Index>& open() const { return open_; }
  const Urgent* urgent() const { return urgent_ == kNone ? nullptr : &urgents_[urgent_]; }
  const Urgent* below(const Urgent& item) const {
    return item.below == kNone ? nullptr : &urgents_[item.below];
  }
  const Network& network() const { return network_; }
  /// Returns the values of a timeline that is predicted, in order.
  std::vector<Index> predicted(Index component) const;
  /// Returns the one of them that something was last put into, or kNone.
  Index last_window(Index component) const { return windows_[component]; }
  /// Returns the goal of the problem for which there is the activity, or kNone.
  Index goal_of(Index activity) const;
  /// Returns the behaviours that a triggered activity chooses among: behaviour and binding.
  const std::vector<std::pair<Index, Index>>& mending(Index activity) const { return mending_[activity]; }
  std::size_t mending_count() const { return mending_.size(); }

  bool complete(Index activity) const {
    return activities_[activity].placed && activities_[activity].open_parts == 0;
  }
  /// Returns whether the activity is a behaviour that mends an error, or below one.
  bool is_mending(Index activity) const;
  /// Returns whether everything that ends before it is complete, and its timeline is free.
  bool ready(Index activity) const;
  std::vector<Index> before(Index activity) const;
  /// Returns the component of an open activity.
  Index component(Index activity) const { return ground_->at(activities_[activity].state).state.component; }
  /// Returns whether a state was passed already on the path that began at this token.
  bool passed(Index component, StateId state, Index path_from) const;
  /// Returns whether it was passed on the way to rest on which the timeline is.
  bool passed_to_rest(Index component, StateId state) const;
  /// Returns the variables of a need: those of the state, others kNone.
  std::vector<Index> need_variables(Index token) const;
  /// Tells why the last step could not be taken.
  const Obstacle& obstacle() const { return obstacle_; }
  std::size_t refusals_by_time() const { return refusals_by_time_; }
  std::size_t bytes() const;
  /// Ends all timelines at the horizon. Returns whether that can be.
  bool close();

 private:
  enum class Field : std::uint8_t {
    current,
    placed,
    token,
    behaviour,
    binding,
    parts,
    path,
    urgent,
    opened,
    closed,
    ended,
    window
  };
  struct Change {
    Field field;
    Index index;
    Index before;
  };

  // partial_plan.cpp: changes that can be taken back
  void set(Field field, Index index, Index value);
  Index& slot(Field field, Index index);
  bool constrain(TimePoint from, TimePoint to, Duration lower, Duration upper = temporal::no_bound);
  Index add_activity(StateId state, Index parent, const model::Bounds* bounds = nullptr);
  void push(Urgent item);
  void pop();
  void finish(Index activity);
  void open_up(Index activity);
  void place(Index activity);
  bool refuse(Obstacle obstacle);
  bool apply(const Step& step);
  bool leaves_time(std::size_t changes);
  bool may_begin_after(Index activity, TimePoint point);

  // initial_plan.cpp
  void add_predicted(Index component);
  void add_mending();

  // timeline_steps.cpp
  bool wait_for_release(Index activity);
  Index append(StateId state, Index activity, Index cause);
  bool wait_for_mending(Index activity, Index token);
  bool step_between(StateId state, Index cause, Index parent, bool complex_permitted);
  bool attach(Index activity, Index token);
  bool go_on(Index activity, StateId state);
  bool pass(Index activity, StateId state);

  // need_steps.cpp
  bool meet_need(Index token, Index need, Index other);
  bool path_to_need(StateId state, bool passing);
  bool take_window(const Step& step);

  // decomposition_steps.cpp
  bool decompose(Index activity, Index behaviour, Index binding);
  bool conditions_hold(Index activity, const model::Behaviour& behaviour, const std::vector<Index>& objects);
  bool follow(Index component, const model::Pattern& pattern, const std::vector<Index>& objects,
              Index activity);
  bool add_parts(Index activity, const model::Behaviour& behaviour, const std::vector<Index>& objects);
  void widen(model::Bounds& bounds, const model::Behaviour& behaviour, Index variable,
             const model::Pattern& pattern, const std::vector<Index>& objects);
  bool add_choices(Index activity, const model::Behaviour& behaviour, const model::Decision& decision,
                   const std::vector<Index>& objects, Index first);
  bool add_part_constraints(Index activity, const model::Behaviour& behaviour,
                            const std::vector<Index>& objects, Index first);

  Ground* ground_;
  Bindings* bindings_;
  Network network_;
  std::vector<Token> tokens_;
  std::vector<Activity> activities_;
  std::vector<Index> begun_, current_, windows_;
  std::vector<Index> open_;
  std::vector<Urgent> urgents_;
  Index urgent_ = kNone;
  std::vector<Index> before_;
  std::vector<Change> changes_;
  std::vector<std::vector<std::pair<Index, Index>>> mending_;
  bool sound_ = true;
  Obstacle obstacle_;
  std::size_t refusals_by_time_ = 0;
};

}  // namespace roci::planner::timeline_htn::search
