// A ship lock as the proof engines' mission: a chamber between two gates, pumps with a store of energy. No
// robot, no site, no arm.
#pragma once

#include <string>

namespace roci::planner::proof {

inline const std::string kLockModel = R"(# Times in seconds, energy in kJ.
task open-lower   lock_svc gates open-lower 20
  needs level low
  needs upper shut
  needs lower shut
  sets lower open
task shut-lower   lock_svc gates shut-lower 20
  needs lower open
  sets lower shut
task open-upper   lock_svc gates open-upper 20
  needs level high
  needs lower shut
  needs upper shut
  sets upper open
task shut-upper   lock_svc gates shut-upper 20
  needs upper open
  sets upper shut
task fill         lock_svc pumps fill 300
  needs lower shut
  needs upper shut
  needs level low
  uses energy 40
  sets level high
task drain        lock_svc pumps drain 200
  needs lower shut
  needs upper shut
  needs level high
  sets level low
task enter-below  lock_svc winch enter-below 60
  needs lower open
  needs ship below
  sets ship inside
task leave-above  lock_svc winch leave-above 60
  needs upper open
  needs ship inside
  sets ship above
task enter-above  lock_svc winch enter-above 60
  needs upper open
  needs ship above
  sets ship inside
task leave-below  lock_svc winch leave-below 60
  needs lower open
  needs ship inside
  sets ship below
goal lift   ship above
goal lower  ship below
goal close  upper shut
goal close  lower shut
goal flood  quay wet
)";

}  // namespace roci::planner::proof
