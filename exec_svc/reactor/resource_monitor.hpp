/// Whether what is there now suffices for the rest of a plan: energy that was lost is missed long before the
/// activity that lacks it is due (conflicts seen ahead, R72–R74).
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

/// For every numeric timeline that the plan's activities change by a known amount for good, and in no other way (what
/// is given back at an activity's end is waited for): the range in which its value must lie now, so that the pre
/// conditions of all waiting activities hold in plan order.
///
/// Nobody sees how much of it the first attempt of a running activity has taken or given already: it may still do any
/// part of what was planned, and whatever part would do is reckoned with, so that no alarm is false: at the start of a
/// drive it may have taken all its energy, or none. So what is lost beside it is missed once less is left than what
/// follows needs, at its end at the latest; reckoning by the time that has passed would miss it sooner, and raise false
/// alarms where a drive takes most in its first metres. What another attempt will take counts until it is seen.
///
/// An activity that waits no more costs the logarithm of the plan's length, a check two comparisons for each timeline.
class ResourceMonitor {
 public:
  ResourceMonitor() = default;
  /// At first all activities wait.
  explicit ResourceMonitor(const temporal::FlexiblePlan& plan);

  /// The activity waits no more: it was started, skipped or cancelled.
  void remove(const std::string& activity);
  /// It was started and runs: until it is settled it may change its timelines by all that was planned.
  void begin(const std::string& activity);
  /// A running activity is tried again and takes once more, from the values of now on, all that was planned for
  /// it (R99). What has been seen to be taken since then counts no more.
  void charge_again(const std::string& activity, const temporal::Lookup& now);
  /// The activity has ended: nothing more is taken by it.
  void settle(const std::string& activity);
  /// The same; but what a first attempt did may not be seen yet: until a timeline has another value than now, the
  /// activity counts as before.
  void end(const std::string& activity, const temporal::Lookup& now);

  /// The first waiting activity, in plan order, whose pre conditions will fail on the values of now.
  std::optional<PredictedConflict> conflict(const temporal::Lookup& now) const;

 private:
  /// The values that a timeline may have.
  struct Range {
    double low, high;
  };
  /// A part of the plan: what its waiting activities add up to, and the range that they ask of the value
  /// before the first of them.
  struct Segment {
    double change = 0;
    double least, most;
    Segment();
    bool holds(const Range& values) const;
  };
  /// The segments of one timeline as a tree in an array: node i holds 2i and 2i + 1, the leaves are the
  /// activities that touch the timeline.
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
  /// What a further attempt takes from a timeline.
  struct Charge {
    std::string activity;
    double change = 0;
    double expected = 0;  ///< value when all of it has been taken, by nobody else
    double remaining(double value) const;
  };

  /// The value of now, with what is charged, and with all or nothing of what running activities may still do.
  Range reckoned(const std::string& timeline, double value) const;
  static Segment join(const Segment& first, const Segment& second);

  std::map<std::string, Timeline> timelines_;
  std::map<std::string, std::vector<Charge>> charges_;  ///< by timeline
  std::set<std::size_t> under_way_;                     ///< in their first attempts
  /// First attempts that have ended, by timeline: the value at their end.
  std::map<std::string, std::map<std::size_t, double>> unseen_ends_;
  std::vector<Asked> activities_;
  std::unordered_map<std::string, std::size_t> index_of_;
};

}  // namespace roci::exec::reactor
