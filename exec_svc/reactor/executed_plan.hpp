// An executed plan tells what became of a plan: each of its activities with its real times and what its commands
// brought (R129, R144).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::reactor {

/// Says how a plan ended, in the order of ExecutedOutcome in idl/plan.idl.
enum class ExecutedOutcome {
  finished,   ///< every activity succeeded or was skipped
  broken,     ///< and nothing of it runs any more
  cancelled,  ///< its activities were ended early
  replaced,   ///< another plan took its place
};

/// Holds one activity as it was executed; times are mission times.
struct ExecutedActivity {
  std::string id;
  std::string name;
  std::string level;
  std::string parent;
  std::string robot;
  temporal::ActivityState state = temporal::ActivityState::waiting;
  std::optional<temporal::Time> started, ended;
  std::uint32_t attempts = 0;  ///< commands that were sent for it
  std::string cause;           ///< why it is in this state, where that is not obvious
  /// Joins the results of all its commands: energies are summed, and of values with one name the newest
  /// counts.
  executive::CommandResults results;
  friend bool operator==(const ExecutedActivity&, const ExecutedActivity&) = default;
};

/// Holds a whole plan as it was executed, its activities in plan order.
struct ExecutedPlan {
  std::string id;
  std::uint32_t version = 0;
  temporal::Time origin{0};
  ExecutedOutcome outcome = ExecutedOutcome::finished;
  std::string reason;  ///< why the plan broke or was cancelled
  std::vector<ExecutedActivity> activities;
  friend bool operator==(const ExecutedPlan&, const ExecutedPlan&) = default;
};

/// Records what happens to the running plan, until it ends.
class ExecutionRecord {
 public:
  /// Begins the record of a plan that runs from now on. Activities that the plan before had under the same id keep
  /// what is known of them.
  void begin(const temporal::FlexiblePlan& plan);
  void note(const executive::StepStatus& step);
  void note(const executive::CommandAck& ack);
  /// Returns whether a plan has begun and was not closed.
  bool open() const { return open_; }
  ExecutedPlan close(ExecutedOutcome outcome, std::string reason);

 private:
  bool open_ = false;
  ExecutedPlan plan_;
  std::map<std::string, std::size_t> index_;  // in plan_.activities, by id
};

}  // namespace roci::exec::reactor
