// The mission state is what all parts of the reactor share: the mission, its goals and beliefs, the phase,
// and what the step under way puts out.
#pragma once

#include <string>
#include <vector>

#include "exec_svc/beliefs/beliefs.hpp"
#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/orders/authority.hpp"
#include "exec_svc/reactor/messages.hpp"

namespace roci::exec::reactor {

/// Returns the text up to its first line feed.
std::string first_line(const std::string& text);

/// Begins the names of timelines that say whether a subsystem is trusted.
inline constexpr char kTrust[] = "trust.";

/// Holds what the parts of the reactor share; it decides nothing.
struct MissionState {
  /// The model outlives the state.
  explicit MissionState(const mission::MissionModel& model)
      : mission(&model), beliefs(model), goals(model), authority(model.executive.autonomy) {}

  const mission::MissionModel* mission;
  beliefs::Beliefs beliefs;
  goals::GoalSet goals;
  MissionPhase phase = MissionPhase::idle;
  orders::Authority authority;  ///< what the ground leaves to the executive
  bool replan_wanted = false;
  std::string replan_reason;  ///< reason for the newest wish for a plan, also once it has been granted
  ReactorCounts counts;       ///< planner calls and replans; goals are counted when asked for
  ReactorOutputs out;         ///< outputs of the step under way

  void want_plan(const std::string& reason);
  /// Returns whether a plan is wanted and the ground lets it be made: below autonomy E4 only where no plan
  /// runs, under a hold never.
  bool replan_due() const;
  /// Returns whether others are told what was concluded of a timeline. Where the engine plans all the time that is only
  /// who is not trusted: such an engine keeps the timelines of its plan itself, and knows, too, what tasks with
  /// commands have made of them.
  bool tells_conclusion(const std::string& timeline) const;
  /// Reports an event to operators.
  void report(Severity level, std::string code, std::string text);
  void set_goal(const goals::GoalKey& key, goals::GoalState goal_state, const std::string& reason,
                std::uint32_t plan_version = 0);
  /// Ends goals that cannot be reached. Hard ones are never dropped: they fail, and the ground is asked. The goal keeps
  /// all lines of the reason; operators are told the first, which is in the words of the mission.
  void give_up(const std::vector<goals::GoalKey>& keys, const std::string& reason);
  std::vector<goals::GoalKey> open_goals() const;
  void wake_at(temporal::Time time);

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    orders::Authority::fields(archive, self.authority);
    archive(self.phase, self.replan_wanted, self.replan_reason, self.counts);
  }
};

}  // namespace roci::exec::reactor
