// This search gives a plan early and better ones later, and says how far from the best possible it may be.
#pragma once

#include <cstdint>
#include <functional>

#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Holds the best plan so far.
struct Progress {
  Outcome outcome;
  temporal::RankVector bound{};  ///< no plan has more (see bound.hpp)
  temporal::RankVector gap{};    ///< bound − utility, 0 at all ranks: nothing better exists
  std::uint64_t entries = 0;     ///< taken in all passes
};

/// Says how long to go on.
struct Effort {
  std::uint64_t first_entries = 64;    ///< of each batch in the first pass; each pass takes twice as many
  std::uint64_t all_entries = 20'000;  ///< no pass begins after as many
};

/// Plans pass by pass, until a pass has seen everything, the gap is 0, the effort is spent, or the problem's `stop`
/// says so. `better` is told each plan that is better than all before; its utility never falls, and of equal ones its
/// cost. Returns the last of them.
Progress search_anytime(const Problem& problem, const Effort& effort,
                        const std::function<void(const Progress&)>& better = {});

}  // namespace roci::planner::utility_htn::search
