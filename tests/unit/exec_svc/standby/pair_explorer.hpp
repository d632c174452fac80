// All that can happen to a pair of executives, three owners and the ground within bounds, by depth-first search over
// the real values: whoever finds a state in which a promise is broken also has the way there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/unit/exec_svc/standby/pair_events.hpp"

namespace roci::exec::testing {

struct Exploration {
  std::size_t states = 0;  // that differ
  std::size_t transitions = 0;
  std::vector<std::string> way;  // what happened until a promise was broken, and how; empty: none was
};

Exploration explore(const Bounds& bounds, Bug bug);

}  // namespace roci::exec::testing
