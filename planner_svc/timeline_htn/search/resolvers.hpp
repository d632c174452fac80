// Several searches run side by side (R132): the first among them by work, not by time, gives the plan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

/// Returns the resolver of a name: that of a heuristic (blind, relaxed_plan, landmarks), with "_last" behind it where
/// the last of equal things is tried first; nothing for any other text.
std::optional<Resolver> resolver_named(std::string_view name);
/// Returns all such names.
std::vector<std::string> resolver_names();

/// Holds the outcome of several searches side by side.
struct Resolution {
  Outcome outcome = Outcome::searching;
  std::unique_ptr<Search> search;  ///< whose plan or whose reason it is
  std::size_t resolver = 0;        ///< its place among the resolvers
  std::uint64_t expanded = 0;      ///< by all of them
  std::uint64_t evaluated = 0;
};

/// Lets all resolvers search in rounds, each twice as long as the one before, on at most so many threads. In the first
/// round in which some have solved the problem the one with the fewest expansions wins, of equal ones the first; one
/// that has exhausted it ends all. So the plan is the same, byte for byte, for any number of threads. `evaluations` and
/// `memory_bytes` (0: no bound) are shared evenly.
Resolution resolve(const model::Model& model, const std::vector<Resolver>& resolvers, std::size_t threads,
                   std::uint64_t evaluations, std::size_t memory_bytes,
                   const std::function<bool()>& cancelled);

}  // namespace roci::planner::timeline_htn::search
