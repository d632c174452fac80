// Problems of any size of the kind that the engine is for: a primary rover whose scouts go ahead
// from way-point to way-point.
#pragma once

#include <string>

namespace roci::bench::timeline_htn {

struct TeamTraverse {
  int waypoints = 13;
  int rovers = 2;  ///< the primary and its scouts
  int goals =
      2;  ///< traverses one after the other, each over its part of the way-points, the last one a communication
  int chords = 0;  ///< each way-point has edges to so many beyond the next one
};

/// Returns domain, behaviours and problem as one text. With two rovers a cycle has 18 transitions on five
/// timelines, as the paper's has.
std::string text_of(const TeamTraverse& team);

}  // namespace roci::bench::timeline_htn
