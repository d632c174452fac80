// The level of autonomy says how much the executive decides without the ground.
#pragma once

namespace roci::exec::mission {

/// Names the levels of autonomous execution, after those of ECSS-E-ST-70-11C, in the order of AutonomyLevel in
/// idl/order.idl.
enum class AutonomyLevel {
  e1,  ///< each command waits for an approval; nothing is retried or replanned on board
  e2,  ///< commands start at fixed times; nothing is retried or replanned on board, a broken plan makes safe and waits
  e3,  ///< local recovery (retries, contingencies), no replanning
  e4,  ///< everything
};
/// Returns "E1" to "E4".
const char* to_string(AutonomyLevel level);

}  // namespace roci::exec::mission
