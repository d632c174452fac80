// The inputs of an engine that plans all the time: what it is to hear with its next step, and what it is told again
// when it is made anew or goes on from a version that it did not send (R66).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner {

/// Keeps the newest of all that is heard, and collects what of it the engine has not heard. Each hear...()
/// returns whether the engine has something to hear of it. A name beyond the bounds of limits.hpp is not taken in.
class EngineInputs {
 public:
  /// Is called with the kind of thing that found no room, and with how many of it are kept.
  using Refused = std::function<void(const char* what, std::size_t room)>;

  explicit EngineInputs(Refused refused) : refused_(std::move(refused)) {}

  /// Take in a goal, and what the executive says of it. A goal is the engine's from the executive's word that it is
  /// open to its word that it is not.
  bool hear(engine::Goal goal);
  bool hear_status(const std::string& issuer, const std::string& id, engine::GoalState state);
  bool hear(engine::Observation observation);
  bool hear(engine::StepStatus step);
  /// Takes in a product; what has changed in `told` alone is no news.
  bool hear(engine::DataProduct product);
  /// Takes in what a command of `commander` took and brought. It is no news before the executive is known.
  bool hear(const std::string& commander, engine::CommandResult result);

  /// Takes in who executes the plan, which it learns once; results of all others are forgotten then.
  void note_executive(const std::string& executive);
  /// Forgets steps and results of what has left the plan: it never comes again by its id, and a long mission
  /// has no end of it.
  void note_executed(const temporal::FlexiblePlan& plan);

  bool waiting() const;
  /// Returns what was heard since the time before.
  engine::StepInputs take() { return std::exchange(heard_, {}); }
  /// Adds all that became of the executed version that `inputs` hold, for an engine that did not send it.
  void tell_again(engine::StepInputs& inputs) const;
  /// Lets the next take() have all goals, observations and products that still count, as observed `now`. Steps
  /// and results come with the executed version.
  void engine_is_new(temporal::Time now);

  /// Returns the goals that the engine has been told of, or will be, as open.
  std::vector<engine::Goal> open_goals() const;
  const engine::Timelines& state() const { return state_; }
  const temporal::Progress& progress() const { return progress_; }

 private:
  using Key = std::pair<std::string, std::string>;                        // issuer, id
  using ResultKey = std::tuple<std::string, std::string, std::uint32_t>;  // commander, activity, attempt
  struct HeardGoal {
    std::optional<engine::Goal> goal;
    std::optional<engine::GoalState> state;  // as the executive says
    bool told = false;                       // to the engine, as open
  };

  /// Returns whether a table has room for this name, or knows it already.
  template <class Table>
  bool has_room(const Table& table, const typename Table::key_type& name, std::size_t room,
                const char* what) const;
  bool note_goal(const Key& key, HeardGoal& heard, bool changed);

  Refused refused_;
  engine::StepInputs heard_;                             // since the step before
  std::string executive_;                                // whose plan it is; empty: not known yet
  std::map<Key, HeardGoal> goals_;                       // all of this run
  engine::Timelines state_;                              // newest observations
  std::map<std::string, engine::DataProduct> products_;  // by id
  temporal::Progress progress_;                          // of the executed version
  std::map<ResultKey, engine::CommandResult> results_;   // likewise, of completed commands
};

}  // namespace roci::planner
