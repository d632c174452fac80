// This is the utility-maximizing search over partial plans (MEXEC, section III.A and algorithm 1, R93–R97,
// with the readings Z7, Z8 and Z12).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/temporal/rank_vector.hpp"
#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/data_product.hpp"
#include "planner_svc/utility_htn/model/network.hpp"
#include "planner_svc/utility_htn/search/scheduler.hpp"

namespace roci::planner::utility_htn::search {

/// Holds a chain in a plan, with the start of each of its links.
struct Placed {
  std::uint32_t chain = 0;
  std::vector<temporal::Time> starts{};
  friend bool operator==(const Placed&, const Placed&) = default;
};

/// Describes a placed task that sends data (Task::downlinks).
struct PlannedDownlink {
  model::TaskIndex task = 0;
  temporal::Time start{0};
  temporal::Time end{0};
  temporal::timelines::TaskId id = 0;  ///< in a plan that runs: the number under which timelines know it
};

/// Says what a partial plan would generate and send. What is committed comes first in both lists.
struct PlannedData {
  std::vector<model::DataProduct> products{};
  std::vector<PlannedDownlink> downlinks{};
  std::size_t committed_products = 0;
  std::size_t committed_downlinks = 0;
};

/// Returns what a task of a request will have generated when it has ended; bytes are rounded up.
model::DataProduct predicted(const model::Task& request, const model::Task& task,
                             const model::Product& product, temporal::Time end, const model::Values& values);

/// Says whether everything that a partial plan would generate gets its downlink (R127).
using DownlinkQuestion = std::function<bool(const PlannedData&)>;

/// Says of a partial plan whose answer was "no" from when on its uncommitted downlinks might do better, since another
/// sol has a limit of its own (R111); none: at no other time.
using LaterDownlinks = std::function<std::optional<temporal::Time>(const PlannedData&)>;

/// Bounds the sols that are tried for the downlinks of one chain.
inline constexpr int kMostSols = 4;

/// Says what is to be planned. All that it refers to outlives it.
struct Problem {
  const model::Network& network;
  const model::Values& values;
  const flattening::Chains& chains;
  const assessor::Assessor& assessor;
  const Scheduler& scheduler;
  /// Committed tasks are placed already; calls leave it as they found it.
  temporal::timelines::Timelines& anchored;
  temporal::Time from{0};                     ///< nothing starts before: the end of the commit window (R80)
  temporal::Time until = temporal::no_bound;  ///< everything has ended by then
  double budget = 0;  ///< what a plan costs stays below it; what is committed does not count
  std::span<const double> timelines_now{};  ///< newest values, by timeline Index; for the Assessor
  std::span<const assessor::ExistingProduct> products{};
  std::vector<Placed> committed{};  ///< chains that are placed in `anchored`, begun or not
  /// Says what `committed` generates and sends at its real times; none: as the network says.
  std::optional<PlannedData> standing{};
  std::vector<model::TaskIndex> closed{};    ///< requests that are done, failed for good or withdrawn
  temporal::timelines::TaskId first_id = 0;  ///< see task_id()
  DownlinkQuestion downlink{};               ///< none: every product gets its downlink
  LaterDownlinks later{};                    ///< none: a chain whose data get no downlink is not tried later
  std::function<bool()> stop{};  ///< asked for every entry; true ends the search with what there is
};

/// Returns the number under which a plan's task stands on the timelines, counted from Problem::first_id.
constexpr temporal::timelines::TaskId task_id(std::uint32_t chain, std::size_t link) {
  return (temporal::timelines::TaskId{chain} << 16U) | link;
}

/// Holds a plan: chains by start of their first links, what is committed not among them.
struct Plan {
  std::vector<Placed> placed{};
  temporal::RankVector utility{};  ///< sum, each chain in the context of those that start before it
  double cost = 0;                 ///< sum (R87)
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// Counts what a search did.
struct Statistics {
  /// Counts the pairs of the empty plan and a chain in the queues at the beginning (R93).
  std::uint64_t first_pairs = 0;
  std::uint64_t entries = 0;           ///< pairs taken from the queues
  std::uint64_t nodes = 0;             ///< partial plans, the first one of each batch among them
  std::uint64_t duplicates = 0;        ///< partial plans met again
  std::uint64_t unplaced = 0;          ///< chains that found no place in their plan
  std::uint64_t broken_rules = 0;      ///< placed chains that would break a rule of the mission
  std::uint64_t without_downlink = 0;  ///< placed chains whose data would not get home
  std::size_t bytes = 0;               ///< of the largest batch: nodes, queue and what recognises duplicates
};

/// Holds what a search found.
struct Outcome {
  Plan plan;
  bool complete = false;  ///< every queue ran empty: no order of adding chains gives a better plan
  std::vector<std::uint32_t> missed{};  ///< fixed requests' chains that could not be placed at their time
  Statistics statistics{};
};

/// Bounds the bytes that the nodes of one batch may take. A search that reaches it ends as at its exploration
/// bound.
inline constexpr std::size_t kMostNodeBytes = std::size_t{24} << 20U;

/// Plans: first the fixed requests at their times, then batch by batch, each held fixed for the next (R97). Within a
/// batch the pair of a partial plan P and a chain T with the greatest P.utility + T.utility / T.cost is taken from the
/// queue, rank by rank; T is placed whole or not at all, and the new plan is paired with every chain whose request it
/// does not hold and with which its cost stays below the budget (R94, R95). `entries` pairs are taken in each batch at
/// most. The plan of greatest utility is best, of two equal ones the cheaper, then the one found first (R96).
///
/// Equal problems give equal outcomes. Utilities are compared to a billionth, so that sums of equal scores in another
/// order are equal. A chain that costs nothing has an infinite ratio where it has utility. Equal entries are taken by
/// priority of the request, the older plan first, then the chain that comes first in the network.
Outcome search(const Problem& problem, std::uint64_t entries);
/// Takes as many entries as the network says.
Outcome search(const Problem& problem);

}  // namespace roci::planner::utility_htn::search
