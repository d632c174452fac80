// An explanation says why a chain is not in a plan (R119).
#pragma once

#include <cstdint>
#include <string>

#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::search {

/// Names the reasons why a chain is not in a plan, in the order in which they are looked for.
enum class WhyNot {
  planned,         ///< it is in the plan, or committed
  closed,          ///< its request is done, failed or withdrawn
  other_way,       ///< its request is in the plan in another way
  breaks_rule,     ///< of the mission, as the subway map
  too_dear,        ///< what is left of the budget does not pay it
  out_of_window,   ///< one of its tasks has no time at all in its own window and the plan's
  no_valid_start,  ///< one of its tasks would conflict wherever it starts
  no_downlink,     ///< its data would not get home
  worthless,       ///< it would bring nothing
  not_tried,       ///< it would fit: the search ended before it, or the batch of the chain came first
};

/// Holds the reason, and a sentence for people.
struct Explanation {
  WhyNot reason = WhyNot::not_tried;
  std::string text;  ///< one sentence for people, which names tasks, timelines, times and amounts
};

/// Says why the chain is not in the outcome's plan; an outcome without nodes is of no search. The first reason in the
/// order of WhyNot that holds for the whole plan is given; the timelines are left as they were.
Explanation why_not(const Problem& problem, const Outcome& outcome, std::uint32_t chain);

}  // namespace roci::planner::utility_htn::search
