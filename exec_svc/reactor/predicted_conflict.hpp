/// A conflict seen ahead (R73-R76): an activity of the plan will not find what it needs.
#pragma once

#include <string>

namespace roci::exec::reactor {

struct PredictedConflict {
  std::string activity;     ///< the first waiting one, in plan order, whose pre condition cannot come about
  std::string description;  ///< what it will lack, e.g. "(at a) = true (is false)"
};

}  // namespace roci::exec::reactor
