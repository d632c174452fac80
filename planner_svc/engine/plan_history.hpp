// The plan history has the versions that an engine sent and that may still be changed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

#include "core/temporal/plan_delta.hpp"

namespace roci::planner::engine {

/// Knows the whole plan behind each version from the executed one on, so that a change can be checked as the
/// plan that comes of it.
class PlanHistory {
 public:
  /// Fills `next` with the plan that the delta makes of the version that it changes. Returns what is wrong,
  /// empty if nothing: a version that is not known, is not above all before, or does not fit.
  std::string apply(const temporal::PlanDelta& delta, temporal::FlexiblePlan& next) const;
  /// Returns the version, or null if it is not known.
  const temporal::FlexiblePlan* version(std::uint32_t number) const;
  /// Keeps a plan that was sent, or is executed. Of more than kVersions the second oldest goes, since the oldest
  /// may be executed.
  void keep(temporal::FlexiblePlan plan);
  /// Forgets the versions before this one, which is executed.
  void forget_before(std::uint32_t version);
  std::uint32_t newest() const { return newest_; }

  /// Bounds the versions that are kept, whoever sent them: a busy executive takes none for some seconds.
  static constexpr std::size_t kVersions = 64;

 private:
  std::map<std::uint32_t, temporal::FlexiblePlan> versions_;
  std::uint32_t newest_ = 0;
};

}  // namespace roci::planner::engine
