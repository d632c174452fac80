// The published plan is the engine's plan as the executive knows it: which version it has, which time points stand for
// which links, and whether it knows the values of internal timelines (R66, R73, R81).
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/adapter/open_goals.hpp"
#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "planner_svc/utility_htn/adapter/planned_network.hpp"
#include "planner_svc/utility_htn/adapter/versions.hpp"

namespace roci::planner::utility_htn::adapter {

/// Makes each version as a change of the one before, and says when one is due although the plan is the same.
class PublishedPlan {
 public:
  /// Plans count from this time until a whole one is sent or another process's goes on.
  void begin(temporal::Time origin) { origin_ = origin; }
  temporal::Time origin() const { return origin_; }

  /// Takes in that the next cycle is to send a version, whatever it does.
  void renew() { to_send_ = true; }
  /// Takes in that the executive has not heard of this internal timeline.
  void introduce(const std::string& timeline) { unannounced_.insert(timeline); }
  /// Takes in what the executive says of versions; one that was refused is sent again after a while, in multiples of
  /// `interval`. Returns whether the executive had a plan and has none any more.
  bool hear(const engine::Receipt& receipt, temporal::Time now, temporal::Duration interval);
  /// Takes in what became of the activity that gives internal timelines their values, if `step` is about it.
  void hear(const engine::StepStatus& step);
  /// Takes in that nobody has answered for so long that the newest version counts as lost. Returns whether there was
  /// one.
  bool give_up() { return versions_.give_up(); }
  /// Goes on from this version, whoever sent it; its links have these points.
  void resume(const temporal::FlexiblePlan& executed, Points points);

  /// Returns whether a version is to be sent even if the cycle has changed nothing.
  bool is_due(temporal::Time now) const;
  /// Returns whether the executive has all that there is: what it executes ends by itself, and nothing is planned.
  bool is_over(const cycle::Cycle& cycle) const;
  /// Makes the next version and returns what it changes. The frame gets its origin here.
  temporal::PlanDelta next(const PlannedNetwork& planned, const OpenGoals& goals, Frame frame,
                           temporal::Time now);

 private:
  void announce(const PlannedNetwork& planned, const Frame& frame, bool whole);

  Versions versions_;
  Points points_;
  temporal::Time origin_{0};
  std::optional<temporal::PlanActivity> initial_;  // until it is over
  std::set<std::string> unannounced_;              // internal timelines
  bool to_send_ = false;
  std::uint32_t refused_in_turn_ = 0;
  temporal::Time again_at_{0};  // what was refused
};

}  // namespace roci::planner::utility_htn::adapter
