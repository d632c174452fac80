// Relaxed reachability proves without a search what no plan can come to.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "planner_svc/timeline_htn/search/ground.hpp"

namespace roci::planner::timeline_htn::search {

/// Says what keeps a problem from having a plan.
struct NeverReached {
  Index goal = kNone;  ///< of the problem; kNone: a behaviour that is triggered cannot be carried out
  std::string reason;  ///< which state is not reached, and because of which condition, need or transition
};

/// Proves that there is no plan, or returns nothing: then there may be one.
///
/// The relaxation drops deletes and times: a state that a timeline can come to stays reached. A timeline moves only
/// where a goal, a part of a behaviour or a need asks for a state of it, by transitions on a way to that state; a
/// behaviour begins where states that fit its conditions are reached; a complex state is left where all parts of one of
/// its behaviours come about. What begins but cannot come about is in no plan,
/// so it is left out and all is done again, a few times. Where errors are mended first, the goals are then followed
/// once more, from where the mending leaves the timelines.
///
/// It takes about one step for each state and transition that it meets,
/// and gives up at so many bytes or when it is cancelled.
std::optional<NeverReached> never_reached(const model::Model& model, std::size_t most_bytes,
                                          const std::function<bool()>& cancelled);

}  // namespace roci::planner::timeline_htn::search
