// The timeline store holds values of timelines as conditions see them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::executive {

/// Keeps observed (external) values apart from internal ones, which activities make (R73). A timeline becomes
/// internal when an activity without a command changes it; from then on activities with commands change it,
/// too. A timeline that was observed once stays external, and one that only commands are planned to change
/// stays unknown until it is observed: planned impacts are never taken for the world. Deltas and rates start
/// from 0 where nothing was assigned.
class TimelineStore {
 public:
  void observe(const std::string& timeline, const temporal::Value& value);
  /// Sets the value as an activity without a command does: the timeline is internal from then on, unless it
  /// was observed, and later impacts change it.
  void set(const std::string& timeline, const temporal::Value& value);
  std::optional<temporal::Value> value_of(const std::string& timeline) const;
  /// Returns the value that it would have if the activity, which runs,
  /// gave back what it has taken for as long as it runs.
  std::optional<temporal::Value> value_without(const std::string& activity,
                                               const std::string& timeline) const;

  /// Lets the rates of running activities act up to now.
  void advance(temporal::Time now);

  /// Applies the impacts at the start, and those that last while the activity runs.
  void begin(const temporal::PlanActivity& activity);
  /// Ends the lasting impacts (a delta is taken back, an assignment gives way to the value before it) and, if
  /// the activity succeeded, applies those at the end.
  void end(const temporal::PlanActivity& activity, bool succeeded);

 private:
  struct Lasting {
    std::string timeline;
    temporal::ImpactKind kind;
    double amount = 0;
    std::optional<temporal::Value> before;
  };

  bool is_internal(const temporal::PlanActivity& activity, const temporal::Impact& impact) const;
  void apply(const temporal::Impact& impact);
  void add(const std::string& timeline, double amount);

  std::unordered_map<std::string, temporal::Value> observed_, internal_;
  std::map<std::string, std::vector<Lasting>> lasting_;  ///< goes by activity id
  std::optional<temporal::Time> now_;
};

}  // namespace roci::exec::executive
