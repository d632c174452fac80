// Plans in a few lines. Times are in seconds.
#pragma once

#include <string>
#include <vector>

#include "core/temporal/flexible_plan.hpp"

namespace roci::exec::testing {

/// Adds activities with their own time points and constraints between them.
class PlanBuilder {
 public:
  temporal::FlexiblePlan plan;

  /// An activity of `owner` (empty: no command) lasting [shortest, longest] seconds.
  temporal::PlanActivity& activity(const std::string& id, const std::string& owner, double shortest,
                                   double longest);
  temporal::PlanActivity& activity(const std::string& id, const std::string& owner, double seconds) {
    return activity(id, owner, seconds, seconds);
  }

  temporal::TimePoint point() { return plan.point_count++; }
  temporal::TimePoint start(const std::string& id) const { return find(id).start_point; }
  temporal::TimePoint end(const std::string& id) const { return find(id).end_point; }

  /// `later` starts at least `gap` seconds after `earlier` has ended.
  void after(const std::string& earlier, const std::string& later, double gap = 0.001);
  /// t[to] - t[from] in [lower, upper] seconds; no upper bound if it is negative.
  void between(temporal::TimePoint from, temporal::TimePoint to, double lower, double upper = -1);
  /// The point lies in [lower, upper] seconds after the origin.
  void window(temporal::TimePoint point, double lower, double upper = -1);
  void token(const std::string& timeline, temporal::Value held, temporal::TimePoint from,
             temporal::TimePoint to);

 private:
  const temporal::PlanActivity& find(const std::string& id) const;
};

}  // namespace roci::exec::testing
