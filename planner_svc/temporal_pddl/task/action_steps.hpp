// How a search takes actions.
#pragma once

#include <cstdint>

namespace roci::planner::temporal_pddl {

enum class ActionSteps : std::uint8_t {
  as_needed,  // an action that is not compression safe starts and ends in steps of its own
  whole,      // every action ends at once: no plan has actions that run at the same time because they must
};

}  // namespace roci::planner::temporal_pddl
