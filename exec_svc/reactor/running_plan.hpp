// The running plan is the plan that runs, or ran last: the executive that runs it, what is left of it, and
// whether it still leads to its goals.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/executive/executive.hpp"
#include "exec_svc/reactor/conflict_monitor.hpp"
#include "exec_svc/reactor/executed_plan.hpp"
#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/resource_monitor.hpp"

namespace roci::exec::reactor {

/// Describes a conflict seen ahead, for operators and engines.
struct ConflictAhead {
  std::string activity;
  std::string reason;  ///< in plain words: the activity, when it is due, and what it will lack
};

/// Runs one plan after the other on the executive, watches it for conflicts, and reports what becomes of it.
class RunningPlan {
 public:
  /// The state must outlive this object.
  explicit RunningPlan(MissionState& state);

  /// Tells the executive and the monitors what was observed and acknowledged, in every phase, so that cancels
  /// are answered and observations kept; forwards commands, steps and recoveries. What the plan makes of
  /// timelines that nobody observes may achieve goals.
  void step(temporal::Time now, const ReactorInputs& inputs);
  /// Hands over answers to decisions, which the plan hears in its next step.
  void give_answers(std::vector<executive::DecisionAnswer> answers) { answers_ = std::move(answers); }
  /// Returns what became of the answers that the plan heard in its last step, in their order.
  const std::vector<executive::AnswerResult>& answer_results() const { return answer_results_; }
  /// Sets what the ground lets the executive do from now on, whatever plan runs.
  void permit(executive::Permissions permissions) { executive_.permit(std::move(permissions)); }
  /// Leaves out an activity that has not begun, and what left_out() (relaunch.hpp) adds to it.
  void drop(const std::string& activity, const std::string& reason);
  /// Returns why these activities cannot be left out (relaunch.hpp), or an empty text if they can.
  std::string drop_fault(const std::set<std::string>& dropped) const;
  /// Loads the stopped plan once more, as the next version, and runs what is left of it without these
  /// activities. Returns an empty text, or why that is impossible; nothing has changed then.
  std::string relaunch(temporal::Time now, const std::set<std::string>& dropped);
  /// Replaces the contingency of that name from now on. One that is under way must not be replaced.
  void set_contingency(executive::Contingency contingency) {
    executive_.set_contingency(std::move(contingency));
  }
  bool contingency_under_way(const std::string& name) const { return executive_.contingency_under_way(name); }
  /// Returns the state of an activity that the plan has.
  executive::StepStatus step_of(const std::string& activity) const;

  /// Asks owners, after a restart, what became of all that runs.
  void resume(temporal::Time now);
  void cancel(temporal::Time now);
  /// While held, no activity starts; what runs goes on.
  void hold_starts(bool hold) { executive_.hold_starts(hold); }

  /// Replaces the plan before by this one; what stands in both goes on. Returns an empty text, or what is
  /// wrong with the plan; nothing has changed then.
  std::string load(temporal::FlexiblePlan plan, temporal::Time now);
  /// Tells everybody that the loaded plan runs from now on.
  void begin(temporal::Time now);
  /// Replaces the plan before as load() does, and runs the new one from now on; what goes on stands in its
  /// record.
  std::string take_over(temporal::FlexiblePlan plan, temporal::Time now);
  /// Forgets a plan that has ended, but for its version.
  void unload(temporal::Time now);
  /// Keeps what the planner wrote for the loaded plan, each action with its activity's id.
  void keep_actions(std::vector<PlannedAction> planned) { planned_ = std::move(planned); }

  /// Tells the ground which activities of the running plan that have not begun rest on values of an older
  /// model.
  void note_newer(const ModelVersion& model);

  /// Returns the first activity that will not find what it needs, as far as is known (R73-R76). Asks to be
  /// woken when a conflict will have lasted long enough.
  std::optional<ConflictAhead> conflict_ahead(temporal::Time now);

  /// Note, withdraw and return that the plan must not go on.
  void invalidate() { invalid_ = true; }
  void restore_validity() { invalid_ = false; }
  bool invalid() const { return invalid_; }

  /// Returns the plan that has ended last since the executive was started, or since its last anchor, or nothing
  /// if none has.
  const std::optional<ExecutedPlan>& last_executed() const { return last_executed_; }
  const executive::Executive& executive() const { return executive_; }
  executive::Outcome outcome() const { return executive_.outcome(); }
  /// Returns the version of the plan that was loaded last, also in an earlier start of the executive, or 0 if
  /// none was.
  std::uint32_t version() const { return version_; }
  void restore_version(std::uint32_t version) { version_ = version; }
  /// Returns the executive's epoch, or 0 if it was not told.
  std::uint64_t epoch() const { return epoch_; }
  std::string name() const { return "plan " + std::to_string(version_); }
  /// Returns what the planner wrote; after a restart, the part that had not begun.
  const std::vector<PlannedAction>& planned() const { return planned_; }
  /// Returns what the planner wrote and has not begun.
  std::vector<PlannedAction> remaining() const;
  /// Tells the executive again what was observed before a restart.
  void restore_observations(const std::vector<executive::Observation>& observations);
  /// Tells it likewise what plans have made of timelines that nobody observes.
  void restore_concluded(const std::map<std::string, temporal::Value>& concluded);

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.version_, self.epoch_, self.invalid_, self.reported_starts_, self.condition_values_);
  }

 private:
  void close(ExecutedOutcome outcome, std::string reason);
  void close_record();
  void conclude(const std::vector<executive::StepStatus>& changes, temporal::Time now);
  void end_approvals(const std::vector<executive::StepStatus>& changes);
  void watch(const temporal::FlexiblePlan& plan, bool launched_again = false);
  std::vector<executive::Observation> changed_conditions();
  void tell_observed(const std::vector<executive::Observation>& observations, executive::Inputs& told) const;
  bool is_set_by_ground(const std::string& timeline) const;
  void forward(executive::Outputs done, temporal::Time now);
  void report_windows();

  MissionState* state_;
  executive::Executive executive_;
  std::uint32_t version_ = 0;
  std::uint64_t epoch_ = 0;  // executive's, as the inputs told last
  bool invalid_ = false;
  ExecutionRecord record_;
  std::optional<ExecutedPlan> last_executed_;
  std::vector<PlannedAction> planned_;  ///< actions of the last plan; after a restart what remained of it
  std::vector<executive::DecisionAnswer> answers_;       ///< answers for the next step
  std::vector<executive::AnswerResult> answer_results_;  ///< results of the last step
  ResourceMonitor resource_monitor_;
  ConflictMonitor conflict_monitor_;
  std::map<std::string, temporal::Time> reported_starts_;  ///< earliest starts as last reported, by activity
  /// Holds the timelines of the plan's conditions, as last told to the executive.
  std::map<std::string, temporal::Value> condition_values_;
};

}  // namespace roci::exec::reactor
