// A pair of executives on two hosts that is cut apart in flight, over real (virtual) cables.
#pragma once

#include <ostream>

namespace roci::scenario {

struct Cut {
  const char* where;  // see cut_pair.sh
  const char* dds;
  const char* clock;   // and speed
  const char* leader;  // meanwhile
};

void PrintTo(const Cut& cut, std::ostream* out);

// Whoever leads meanwhile takes a goal in, nothing is lost when they are joined again, neither a goal nor a recall that
// the other one acknowledged, and nothing is done twice.
void expect_nothing_lost(const Cut& cut);

}  // namespace roci::scenario
