/// Components that cannot be heard because services of theirs are gone: first they are waited for, then they count as
/// lost for good (`components: lost` of the mission), so that what is left of the team can go on without them.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "exec_svc/reactor/mission_state.hpp"
#include "exec_svc/reactor/planner_call.hpp"
#include "exec_svc/reactor/safing.hpp"

namespace roci::exec::reactor {

/// Knows the components whose services have been away for as long as the mission allows, and what they then count as.
class LostComponents {
 public:
  /// All outlive this.
  LostComponents(MissionState& state, PlannerCall& call, Safing& safing)
      : state_(&state), call_(&call), safing_(&safing) {}

  /// Takes in who was lost and who came (back). Returns what is to be believed of components whose services have been
  /// away for longer than the mission says, as if it was observed, for as long as one of them is away. The first time
  /// the ground is told (`component.lost`).
  std::vector<executive::Observation> step(temporal::Time now, const ReactorInputs& inputs);

  /// As long as a component is waited for no plan is asked for: it could only count on what cannot be heard. To be
  /// called in each step, after step().
  void hold_planning();

  /// Whether a component is waited for that will count as lost.
  bool awaits() const { return awaited_until_.has_value(); }

  template <class Archive, class Self>
  static void fields(Archive& archive, Self& self) {
    archive(self.away_since_, self.lost_, self.awaited_until_);
  }

 private:
  executive::Observation count_as_lost(const mission::Component& component, const std::string& service);

  MissionState* state_;
  PlannerCall* call_;
  Safing* safing_;
  std::map<std::string, temporal::Time> away_since_;  ///< by service
  std::set<std::string> lost_;                        ///< components that count as lost
  std::optional<temporal::Time> awaited_until_;       ///< of those that are waited for the last one
};

}  // namespace roci::exec::reactor
