// Observations of timelines are compared with what was foreseen (R76, R102): they tell when a better plan may exist,
// and which observation counts where a command that was to change a timeline has not been confirmed.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::cycle {

/// Keeps the newest observation of each timeline.
class Observations {
 public:
  /// `noticeable` is the share of a timeline's first value from which on a deviation matters. The network outlives
  /// this.
  Observations(const model::Network& network, double noticeable);

  /// Returns whether what was observed since `forget_deviations()` is so far from what was foreseen that it matters.
  /// On a timeline of states every difference matters.
  bool take(temporal::timelines::Index timeline, temporal::Time sampled, double value, double foreseen);
  void forget_deviations();

  /// Takes what tasks had made then of a timeline that nobody reports: no older word of the ground counts any more.
  void note(temporal::timelines::Index timeline, temporal::Time at, double value);

  /// Takes that a task with a command ended then, so that the states which it was to bring about should be observed.
  void await(const model::Task& ended, temporal::Time at);
  void await_nothing() { awaited_.clear(); }
  /// Returns the timelines, with their newest values, of which a whole planning interval has brought no observation
  /// since such a task ended. They are awaited no longer.
  std::vector<std::pair<temporal::timelines::Index, double>> take_unconfirmed(temporal::Time now);

  /// Returns whether nothing was observed of the timeline that was sampled then or later.
  bool is_newest(temporal::timelines::Index timeline, temporal::Time sampled) const;
  /// Returns the value observed last.
  std::optional<double> newest(temporal::timelines::Index timeline) const;

 private:
  struct Sample {
    temporal::Time sampled{0};
    double value = 0;
  };

  const model::Network& network_;
  double noticeable_;
  std::vector<double> deviation_;  // by timeline
  std::map<temporal::timelines::Index, Sample> newest_;
  std::map<temporal::timelines::Index, temporal::Time> awaited_;  // since when
};

}  // namespace roci::planner::utility_htn::cycle
