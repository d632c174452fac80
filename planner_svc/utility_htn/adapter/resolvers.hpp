// Resolvers are what a mission chooses of the engine: `planner: {engine: utility_htn, resolvers: [anytime,
// earliest]}`.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/utility_htn/cycle/cycle.hpp"

namespace roci::planner::utility_htn::adapter {

/// Holds the way to search and the scheduler that a mission chose.
struct Resolvers {
  cycle::Search search = cycle::Search::once;
  std::string scheduler = "nearest";  ///< search::make_scheduler() knows it
};

/// Lists what may be named: ways to search ("anytime", "robust") and the schedulers.
std::vector<std::string> resolver_names();

/// Throws std::invalid_argument for a name that is not there, and for two of one kind.
Resolvers read_resolvers(const std::vector<std::string>& names);

}  // namespace roci::planner::utility_htn::adapter
