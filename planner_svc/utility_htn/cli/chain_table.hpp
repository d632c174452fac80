// This file writes the chains of a network as a table, and as JSON.
#pragma once

#include <string>

#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::planner::utility_htn::cli {

/// Holds what an author asks of one chain, with the priors of the network.
struct ChainRow {
  std::string batch;
  std::string name;
  temporal::RankVector utility;
  double cost = 0;        ///< from the budget, in its unit
  double duration_s = 0;  ///< of its links one after the other, with the shortest gaps
};

ChainRow row_of(const model::Network& network, const flattening::Chain& chain, const model::Values& values);

/// Lists the chains, then the greatest cost of each batch's tasks together.
std::string chain_table(const model::Network& network, const flattening::Chains& chains);

/// Holds `network`, `budget`, `ranks` and `chains`, each with `task`, `batch`, `utility`, `cost`,
/// `duration_s`, `links` and `when`.
std::string chain_json(const model::Network& network, const flattening::Chains& chains);

}  // namespace roci::planner::utility_htn::cli
