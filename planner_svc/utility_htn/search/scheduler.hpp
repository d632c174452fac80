// Schedulers place all tasks of a chain on timelines, or none (MEXEC, sections III.A and IV.A.3, R82, R94).
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::search {

/// Describes one task of a chain as a scheduler sees it.
struct Link {
  temporal::timelines::TaskId id = 0;
  temporal::timelines::Footprint footprint{};
  temporal::Duration shortest_gap{0};  ///< from the end of the link before to this start
  temporal::Duration longest_gap = temporal::no_bound;
  temporal::timelines::Interval starts{};  ///< permitted by the task's own window and the plan's
  temporal::Duration preferred_start = temporal::no_bound;  ///< no_bound: none
};

/// Places chains. A scheduler has no state: equal calls give equal placements.
class Scheduler {
 public:
  virtual ~Scheduler() = default;

  /// Returns the starts of all links, which then stand on the timelines without a new conflict; or nothing, and the
  /// timelines are as they were.
  virtual std::optional<std::vector<temporal::Time>> schedule(
      std::span<const Link> links, temporal::timelines::Timelines& timelines) const = 0;
};

/// Bounds how often EarliestScheduler moves an earlier link to its next valid interval, for a link that has no place
/// at all.
inline constexpr std::size_t kMostBacktracks = 8;

/// Starts each link as early as it can. Where a link would have to wait longer than its longest gap, the one before is
/// put off just as far as needed, `attempts` times at most.
///
/// It finds the earliest placement of all links whenever there is one and the attempts suffice, if what permits a link
/// does not depend on when the links before it run (but for the gaps). Without longest gaps it needs no attempts. Where
/// it does depend, a placement may be missed: of the links before one that has no place, only the beginnings of their
/// next valid intervals are tried, kMostBacktracks times.
class EarliestScheduler final : public Scheduler {
 public:
  explicit EarliestScheduler(std::size_t attempts = 256) : attempts_(attempts) {}
  std::optional<std::vector<temporal::Time>> schedule(
      std::span<const Link> links, temporal::timelines::Timelines& timelines) const override;

 private:
  std::size_t attempts_;
};

/// Starts each link that has a preferred start as near to it as it can, the earlier of two equally near; the others as
/// early as they can. It goes back over the valid intervals of earlier links, from the nearest to the farthest,
/// `attempts` placements at most, and then does as EarliestScheduler does. So it places whatever that places, but may
/// miss a nearer placement within an interval.
class NearestScheduler final : public Scheduler {
 public:
  explicit NearestScheduler(std::size_t attempts = 256) : attempts_(attempts) {}
  std::optional<std::vector<temporal::Time>> schedule(
      std::span<const Link> links, temporal::timelines::Timelines& timelines) const override;

 private:
  std::size_t attempts_;
};

/// Lists the names by which make_scheduler() knows schedulers.
std::vector<std::string> scheduler_names();
/// Makes the scheduler "earliest" or "nearest". Throws std::invalid_argument that lists the names for any other.
std::unique_ptr<Scheduler> make_scheduler(std::string_view name);

}  // namespace roci::planner::utility_htn::search
