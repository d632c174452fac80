// A projection shows a plan's timelines over time: what it foresaw, what has come about of it, and what is
// still to come (R71, R72, R76).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::temporal {

/// Says how far an activity has come; times are mission times.
struct ActivityProgress {
  ActivityState state = ActivityState::waiting;
  std::optional<Time> started;
  std::optional<Time> ended;
};
using Progress =
    std::map<std::string, ActivityProgress>;  ///< by activity id; an activity that is missing waits

/// Says on what a projected change rests.
enum class ProjectionKind {
  planned,    ///< the plan alone says so, with everything at its earliest
  executed,   ///< it has started or ended, at the time when it did
  projected,  ///< it runs or waits: it comes not before now, at the earliest that the network then allows
};
/// Returns the name above.
const char* to_string(ProjectionKind kind);

/// Holds what was seen of a timeline: its value, as its owner sampled it.
struct ObservedValue {
  Time sampled{0};
  Value value;
};
using ObservedValues = std::map<std::string, ObservedValue>;  ///< by timeline

/// Says that the timeline has `value` from `time` on; between two changes a number that is under a rate runs
/// straight.
struct ProjectedChange {
  Time time{0};
  Value value;
  ProjectionKind kind = ProjectionKind::planned;
  std::string activity;
};

/// Returns by timeline the planned changes, then the executed ones, then the projected ones, each in the
/// order of time. The projected values of a timeline that was observed start at that observation (R76): what
/// was executed until it was sampled is in it, and stands among the executed changes without an activity;
/// what runs on (a rate) or comes later acts on it. Planned and executed numbers start with their value in
/// `initial`, else with what the observation tells of it, reckoned back by what was executed until then, else
/// with 0: they are then the change since the plan began. What failed, was
/// skipped or cancelled has no effect at its end. Of activities that exclude each other (decision points) all
/// that are not skipped count. Only timelines that the plan changes are in the result. The plan must have
/// passed check().
std::map<std::string, std::vector<ProjectedChange>> project(const FlexiblePlan& plan,
                                                            const Progress& progress, Time now,
                                                            const std::map<std::string, Value>& initial,
                                                            const ObservedValues& observed = {});

}  // namespace roci::temporal
