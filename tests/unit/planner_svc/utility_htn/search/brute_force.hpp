// An oracle for the search: it tries every order of every subset of chains.
#pragma once

#include <random>

#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace roci::planner::utility_htn::search {

/// Returns the plan of greatest utility, then least cost, that comes about by adding chains one after the other. `most`
/// gets the greatest score of any plan at each rank.
Plan best_by_brute_force(const Problem& problem, std::vector<double>& most);

/// Draws three to four requests of one or two chains with windows, gaps, phases and the arm; `sites`: they sample two
/// sites, in which a first sample opens what the others need.
void draw(std::mt19937_64& random, Toy& toy, bool sites);

}  // namespace roci::planner::utility_htn::search
