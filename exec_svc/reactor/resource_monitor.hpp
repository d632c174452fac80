// The resource monitor checks whether present amounts suffice for the rest of a plan: lost energy is noticed
// long before the activity that lacks it is due (conflicts seen ahead, R72–R74).
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

/// Knows, for every numeric timeline that the plan's activities change only by known lasting amounts (what is given
/// back at an activity's end is waited for), the range in which its value must lie now so that the pre conditions of
/// all waiting activities hold in plan order.
///
/// Nobody sees how much of its planned amount the first attempt of a running activity has taken or given already, from
/// nothing to all. No alarm is raised if any such part would explain the value, so no alarm is false. A loss beside it
/// is thus noticed once less is left than what follows needs, at the activity's end at the latest. Interpolating by
/// elapsed time would notice it sooner, but raise false alarms where a drive takes most in its first metres. What
/// another attempt will take counts until it is seen.
///
/// Removing an activity costs the logarithm of the plan's length, a check two comparisons for each timeline.
class ResourceMonitor {
 public:
  ResourceMonitor() = default;
  /// Starts with all activities waiting.
  explicit ResourceMonitor(const temporal::FlexiblePlan& plan);

  /// Removes an activity that no longer waits: it was started, skipped or cancelled.
  void remove(const std::string& activity);
  /// Notes that the activity was started: until it is settled it may change its timelines by all that was
  /// planned.
  void begin(const std::string& activity);
  /// Charges a running activity that is tried again once more, from the values of `now` on, with all that was
  /// planned for it (R99). Amounts that were seen to be taken since then are no longer charged.
  void charge_again(const std::string& activity, const temporal::Lookup& now);
  /// Notes that the activity has ended and takes nothing more.
  void settle(const std::string& activity);
  /// Notes the same, where the effect of a first attempt may not be observed yet: until a timeline has another
  /// value than `now`, the activity counts as before.
  void end(const std::string& activity, const temporal::Lookup& now);

  /// Returns the first waiting activity, in plan order, whose pre conditions will fail on the values of
  /// `now`.
  std::optional<PredictedConflict> conflict(const temporal::Lookup& now) const;

 private:
  /// Bounds the values that a timeline may have.
  struct Range {
    double low, high;
  };
  /// Sums up a part of the plan: what its waiting activities add, and the range that they ask of the value
  /// before the first of them.
  struct Segment {
    double change = 0;
    double least, most;
    Segment();
    bool holds(const Range& values) const;
  };
  /// Holds the segments of one timeline as a tree in an array: node i joins 2i and 2i + 1, and the leaves are
  /// the activities that touch the timeline.
  struct Timeline {
    std::vector<std::size_t> activities;
    std::vector<Segment> tree;
    std::size_t leaves() const { return tree.size() / 2; }
    void build(const std::vector<Segment>& of_activities);
    void clear(std::size_t leaf);
    std::optional<std::size_t> first_failing(Range values, Range& before) const;
  };
  struct Asked {
    std::string id;
    temporal::Condition pre;
    std::map<std::string, double> changes;  ///< by timeline, the amounts that it adds
  };
  /// Holds what a further attempt takes from a timeline.
  struct Charge {
    std::string activity;
    double change = 0;
    double expected = 0;  ///< value once it has taken all, if nobody else takes any
    double remaining(double value) const;
  };

  /// Returns the range of the present value after charges, with nothing or all of what running activities may
  /// still do.
  Range reckoned(const std::string& timeline, double value) const;
  static Segment join(const Segment& first, const Segment& second);

  std::map<std::string, Timeline> timelines_;
  std::map<std::string, std::vector<Charge>> charges_;  ///< by timeline
  std::set<std::size_t> under_way_;                     ///< activities in their first attempts
  /// Holds, by timeline, the value at the end of first attempts whose effect is not observed yet.
  std::map<std::string, std::map<std::size_t, double>> unseen_ends_;
  std::vector<Asked> activities_;
  std::unordered_map<std::string, std::size_t> index_of_;
};

}  // namespace roci::exec::reactor
