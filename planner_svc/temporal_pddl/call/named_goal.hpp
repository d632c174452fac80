// Goals as whoever asks for them knows them, beside the one goal of a PDDL problem.
#pragma once

#include <string>
#include <vector>

namespace roci::planner::temporal_pddl::call {

/// Some facts of the problem's goal that belong together under a name.
struct NamedGoal {
  std::string name;
  std::vector<std::string> facts;  ///< "(sent image-1)", "(not (open door))"
};

/// A fact of the problem's goal that was found to be out of reach, and why.
struct BlockedFact {
  std::string fact;    ///< written as in NamedGoal
  std::string reason;  ///< empty: no sequence of actions reaches it, and that is all
};

}  // namespace roci::planner::temporal_pddl::call
