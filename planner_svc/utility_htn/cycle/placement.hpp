// The placement of a planning cycle consists of blocks of primitive tasks, one block for each chain that was
// chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::planner::utility_htn::cycle {

using temporal::timelines::TaskId;

/// Says how far a placed task has come. From `committed` on it is the executive's, and is never changed (R78, R81).
enum class Stage {
  planned,
  committed,
  doomed,  ///< committed, but behind a link that has failed: it is skipped when its turn comes, and uses nothing
  running,
  succeeded,
  failed,
};

constexpr bool is_over(Stage stage) { return stage == Stage::succeeded || stage == Stage::failed; }

/// Holds one primitive task of a block; its times are planned first, projected while it is late, and actual in the
/// end.
struct Link {
  model::TaskIndex task = 0;
  temporal::Time planned{0};  ///< start that the executive is told
  temporal::Time start{0};
  temporal::Time end{0};
  Stage stage = Stage::planned;
  temporal::Duration told{0};  ///< what it takes as the executive was told; 0: not committed yet
  std::uint64_t generated = 0;  ///< bit i: product i of the task is there already, before the task is over
  friend bool operator==(const Link&, const Link&) = default;
};

/// Returns whether the link has not begun, but will.
constexpr bool waits(const Link& link) {
  return link.stage == Stage::planned || link.stage == Stage::committed;
}

/// Returns whether the timelines hold the link.
constexpr bool is_placed(const Link& link) { return !is_over(link.stage) && link.stage != Stage::doomed; }

/// Holds a chain as it was placed. Its number is never used again.
struct Block {
  std::uint32_t number = 0;
  std::uint32_t chain = 0;  ///< index in flattening::Chains
  std::vector<Link> links;

  /// Returns whether something of it is committed or has begun: then it stands.
  bool begun() const;
  bool over() const;
  bool failed() const;
  friend bool operator==(const Block&, const Block&) = default;
};

/// Returns the number under which timelines know a link.
constexpr TaskId task_id(std::uint32_t block, std::size_t link) { return (TaskId{block} << 32U) | link; }
constexpr std::uint32_t block_of(TaskId task) { return static_cast<std::uint32_t>(task >> 32U); }
constexpr std::size_t link_of(TaskId task) { return static_cast<std::size_t>(task & 0xffffffffU); }

}  // namespace roci::planner::utility_htn::cycle
