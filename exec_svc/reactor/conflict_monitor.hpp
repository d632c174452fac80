// The conflict monitor checks whether the present state leaves the rest of a plan possible: a state that
// somebody else changed, and that nothing in the plan restores, is noticed long before the activity that
// needs it is due (conflicts seen ahead, R73–R76).
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/reactor/predicted_conflict.hpp"

namespace roci::exec::reactor {

/// Watches every timeline that the plan's pre conditions compare with a truth or a state. It raises an alarm
/// only if no other waiting or running activity assigns a suitable value, wherever it stands in the plan, and
/// only if the conflict lasts, since observations may follow the end of an activity. An activity that may be
/// skipped, is an open choice, or is pushed until somebody else makes it possible demands nothing. A change
/// of a timeline costs time in the number of activities that touch it.
class ConflictMonitor {
 public:
  ConflictMonitor() = default;
  ConflictMonitor(ConflictMonitor&&) = default;  ///< movable only: a copy would point into the original
  ConflictMonitor& operator=(ConflictMonitor&&) = default;
  /// Starts with all activities waiting. `foreseen` are timelines that change by themselves, as their timed
  /// windows say; they raise no alarm. `lasting` is how long a conflict must last.
  ConflictMonitor(const temporal::FlexiblePlan& plan, const std::set<std::string>& foreseen,
                  temporal::Duration lasting);

  /// Takes over what `before` saw, and since when, for a plan that is a new version of the one it watched.
  void continue_from(const ConflictMonitor& before);

  void observe(const std::string& timeline, const temporal::Value& value);
  void change(const std::string& activity, temporal::ActivityState state);

  /// Returns the conflict of the earliest activity, among those that have lasted long enough.
  std::optional<PredictedConflict> conflict(temporal::Time now);
  /// Returns when a known conflict will have lasted long enough.
  std::optional<temporal::Time> next_check() const;

 private:
  struct Consumer {
    std::size_t activity;
    temporal::ConditionNode node;
  };
  struct Producer {
    std::size_t activity;
    temporal::Value value;
  };
  struct Timeline {
    std::vector<Consumer> consumers;
    std::vector<Producer> producers;
    std::optional<temporal::Value> value;
    const Consumer* conflict = nullptr;
    temporal::Time since{0};
  };

  const Consumer* first_unmet(const Timeline& timeline) const;
  void update(temporal::Time now);

  temporal::Duration lasting_{0};
  std::map<std::string, Timeline> timelines_;
  std::set<std::string> touched_;
  std::vector<std::string> ids_;
  std::vector<temporal::ActivityState> states_;
  std::unordered_map<std::string, std::size_t> index_of_;
  std::vector<std::vector<std::string>> touched_by_;  ///< timelines of each activity
};

}  // namespace roci::exec::reactor
