// A version is a plan version as the executive is told it, taken apart for the independent checker.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/projection.hpp"
#include "planner_svc/utility_htn/checking/question.hpp"

namespace roci::planner::utility_htn::checking {

/// Holds what a FlexiblePlan of the utility-driven engine says; planner_svc/utility_htn/README.md has the
/// form.
struct Version {
  std::vector<Block> blocks;                 ///< those of which no link has failed
  std::set<std::uint32_t> broken;            ///< numbers of the others: what is committed of them is skipped
  std::vector<Step> rests;                   ///< what runs or has succeeded of those
  std::vector<model::TaskIndex> broken_off;  ///< their requests, in the order of the numbers
  std::set<std::uint32_t> over;              ///< numbers of those that have ended
  model::Values values;                      ///< of parameters
  std::vector<Observation> internal;         ///< of timelines that nobody reports, as of the version
  /// Lists values of reported timelines that are expected at any time, though something else was reported last: what a
  /// task that runs by itself has begun with, such as a view of Earth, or what a command that has ended within the
  /// last interval was to bring about.
  std::vector<Observation> expected;
  std::vector<model::TaskIndex> closed;  ///< requests that are done or withdrawn
  std::vector<std::string> faults;       ///< of the form
};

/// Returns the number of the step that an activity is; nothing if it is none.
std::optional<std::uint64_t> step_named(const std::string& activity);

/// Returns the number of a block.
std::uint32_t number_of(const Block& block);

/// Reads a plan. What has begun or ended has its actual times,
/// and what is late begins or ends at `now`; `progress` may be null.
Version version_of(const model::Network& network, const temporal::FlexiblePlan& plan,
                   const temporal::Progress* progress, temporal::Time now);

/// Returns the downlinks of a plan that are over, with the times that they really had.
std::vector<Step> downlinks_over(const model::Network& network, const temporal::FlexiblePlan& plan,
                                 const temporal::Progress& progress);

}  // namespace roci::planner::utility_htn::checking
