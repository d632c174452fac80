// A predicted conflict is one that is seen ahead (R73-R76).
#pragma once

#include <string>

namespace roci::exec::reactor {

/// Says that an activity of the plan will not find what it needs.
struct PredictedConflict {
  std::string activity;     ///< the first waiting one, in plan order, whose pre condition cannot come about
  std::string description;  ///< what it will lack, e.g. "(at a) = true (is false)"
};

}  // namespace roci::exec::reactor
