// This file turns a cycle's blocks into the plan that the executive runs, and back (R66, R84, R98, R99).
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::adapter {

/// Holds what a plan says beside its blocks.
struct Frame {
  std::string engine;
  std::string robot;
  std::uint32_t version = 0;
  temporal::Time origin{0};
  std::vector<std::string> goals;    ///< keys of those that every activity serves
  std::set<std::string> measured{};  ///< activities whose measurements are in the values already
  std::map<std::uint32_t, double> spent_j{};  ///< by downlinks that have left the plan, by sol
};

/// Gives time points to links; they keep them as long as they are in the plan, and then others may have them. So the
/// number of points is bounded by what plans hold at once, and not by what the mission has ever held (R82).
class Points {
 public:
  /// Point 1 bounds what holds from the origin on: values of internal timelines, and what is done.
  static constexpr temporal::TimePoint kPast = 1;
  /// Stands for the activity that a whole plan begins with; blocks count from 1.
  static constexpr cycle::TaskId kInitial = cycle::task_id(0, 0);

  /// Returns the two of the link, which gets the lowest that are free if it has none.
  std::pair<temporal::TimePoint, temporal::TimePoint> of(cycle::TaskId task);
  void set(cycle::TaskId task, temporal::TimePoint start, temporal::TimePoint end);
  /// Frees the points of all but the links of these blocks, and of the initial activity unless it is kept.
  void keep_only(const std::vector<cycle::Block>& blocks, bool initial);
  std::uint32_t count() const;

 private:
  std::map<cycle::TaskId, std::pair<temporal::TimePoint, temporal::TimePoint>> of_;
  std::set<temporal::TimePoint> taken_;  // even ones, each with the one that follows
};

/// Names the token that says up to which mission time, in seconds, the other tokens of the past count.
inline constexpr char kPastUntil[] = "past_until";
/// Names the token that holds the number of the newest block: a number is never given again, or two activities would
/// have one name, and their commands one key.
inline constexpr char kLastBlock[] = "last_block";

/// Returns whether a token may hold this number as a count.
constexpr bool is_count(double number) { return number >= 0 && number <= 1e9; }

/// Returns the plan: blocks that are not over with all their links, each not before its planned start, pushed for as
/// long as its wait timeout; a token for each block, which holds its chain's name and number; and from the origin to
/// Points::kPast one token for each thing of the past that is needed to go on after a restart. What was committed in
/// `told` stands as it does there (R78).
temporal::FlexiblePlan plan_of(const model::Network& network, const flattening::Chains& chains,
                               const cycle::Cycle& cycle, const Frame& frame,
                               const temporal::FlexiblePlan& told, Points& points);

/// Returns an activity without a command that gives internal timelines the values they have (R73); a plan that comes
/// whole begins with it.
temporal::PlanActivity initial_activity(const model::Network& network, const cycle::Past& past,
                                        const Frame& frame);

/// Returns whether the activity is one of initial_activity().
bool is_initial(const temporal::PlanActivity& activity);

/// Holds what a plan tells of the cycle that made it.
struct Recovered {
  cycle::Past past;
  /// Says when internal timelines had the values of `past`; none: the plan is of an engine that did not tell.
  std::optional<temporal::Time> past_until{};
  std::vector<cycle::Block> blocks;
  std::uint32_t last_block = 0;
  Points points;
  std::set<std::string> measured{};           ///< as in Frame
  std::map<std::uint32_t, double> spent_j{};  ///< as in Frame
};

/// Reads a plan of plan_of() for the same network. Times are the planned ones, stages planned or committed. Throws
/// std::invalid_argument for one that is of another network.
Recovered recover(const model::Network& network, const flattening::Chains& chains,
                  const temporal::FlexiblePlan& plan);

/// Returns the id of an activity, e.g. "collect_1_2#12.3", and back.
std::string activity_id(const model::Network& network, const cycle::Link& link, cycle::TaskId id);
std::optional<cycle::TaskId> task_of(const std::string& activity);

/// Returns the value as a number of the timeline; nothing if it is none of its values.
std::optional<double> number_of(const temporal::timelines::Definition& timeline,
                                const temporal::Value& value);
temporal::Value value_of(const temporal::timelines::Definition& timeline, double number);

}  // namespace roci::planner::utility_htn::adapter
