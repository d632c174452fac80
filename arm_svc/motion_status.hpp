// These are the outcomes of asking for a motion.
#pragma once

#include <string_view>

namespace roci::arm {

/// Says whether there is a motion, or why not.
enum class MotionStatus {
  found,
  unknown_pose,  ///< The mission's data have no pose of that name.
  unreachable,   ///< The joint values lie beyond the limits, or the position beyond the arm's reach.
  unsolved,      ///< No joint values were found that put the tool there.
  in_collision,  ///< The pose itself touches something.
  no_path,       ///< The search budget shows no way between the two.
  overloaded,    ///< The motors would have to exert more than their effort limits, however slowly.
  faulty,        ///< The payload has no mass or no size that could be.
  cancelled,
};

/// Returns the name above.
std::string_view name_of(MotionStatus status);

}  // namespace roci::arm
