// Pre-processing (MEXEC, section III.A, R92): the hierarchy of a network becomes chains of primitive tasks,
// once, before any search.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::flattening {

/// Describes one way to do a requested task: its primitive tasks in order. A requested primitive task is a chain
/// of one.
struct Chain {
  model::TaskIndex task = 0;  ///< that is requested
  std::string name;  ///< "sample_0_1/first/raw": the task and the decompositions chosen, from the top
  std::vector<model::Subtask> links;  ///< primitive tasks; the gaps count from the link before
  /// Holds the conditions of all decompositions chosen; they hold at the first start.
  std::vector<temporal::timelines::Constraint> when;
};

/// Holds the chains of each batch, in the order of the network.
struct Chains {
  std::vector<Chain> chains;
  std::vector<std::vector<std::uint32_t>> by_batch;  ///< indices of chains
};

/// Bounds the chains of one requested task, since their number is a product.
inline constexpr std::size_t kMostChains = model::kMostChains;

/// Flattens all that is requested. Throws std::invalid_argument with the task's id for one with more than kMostChains;
/// the network is checked already, so parents have no cycle.
Chains flatten(const model::Network& network);
/// Flattens these templates, too, so that they can be requested later.
Chains flatten(const model::Network& network, const std::set<model::TaskIndex>& templates);

/// Flattens all that is requested or may come to be: the templates that contingencies request, too.
Chains flatten_all(const model::Network& network);

/// Returns the templates that contingencies request (R69).
std::set<model::TaskIndex> templates_on_call(const model::Network& network);

/// Returns what timelines see of a chain's link. The first one moreover asks at its start for what selects
/// its decompositions (R89).
temporal::timelines::Footprint footprint(const model::Network& network, const Chain& chain, std::size_t link,
                                         const model::Values& values);

/// Sum cost and utility over the links (R92).
double cost(const model::Network& network, const Chain& chain, const model::Values& values);
temporal::RankVector utility(const model::Network& network, const Chain& chain, const model::Values& values);

}  // namespace roci::planner::utility_htn::flattening
