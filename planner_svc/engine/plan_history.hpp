// The versions that an engine sent and that may still be changed.
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
  /// The plan that the delta makes of the version that it changes: filled in `next`. Returns what is wrong,
  /// empty if nothing: a version that is not known, or not above all before, or does not fit.
  std::string apply(const temporal::PlanDelta& delta, temporal::FlexiblePlan& next) const;
  /// Null: the version is not known.
  const temporal::FlexiblePlan* version(std::uint32_t number) const;
  /// The plan was sent, or is executed. Of more than kVersions the second oldest goes: the oldest may be executed.
  void keep(temporal::FlexiblePlan plan);
  /// This version is executed: those before it are changed no more.
  void forget_before(std::uint32_t version);
  std::uint32_t newest() const { return newest_; }

  /// So many versions are kept, whoever sent them: an executive that is busy takes none for some seconds.
  static constexpr std::size_t kVersions = 64;

 private:
  std::map<std::uint32_t, temporal::FlexiblePlan> versions_;
  std::uint32_t newest_ = 0;
};

}  // namespace roci::planner::engine
