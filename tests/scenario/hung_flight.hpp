// A flight in which processes hang or are killed, all in the same moment, and what must come of it.
#pragma once

#include <ostream>
#include <string>

namespace roci::scenario {

struct Hang {
  const char* name;
  const char* dds;
  const char* returning;  // as in hung.sh, likewise the next two
  const char* lost;
  const char* killed;
  const char* more = "--speed 500 --watchdog 4";  // options of the launcher
};

std::string name_of(const Hang&);  // for gtest
void PrintTo(const Hang&, std::ostream*);

// Every goal is achieved, the one that was sent meanwhile among them; nothing is done twice; the journal
// leads to the same decisions again.
void expect_achieved(const Hang&);

// The run ends by itself with exit code 3, and the goals that were taken in stand in its journal.
void expect_ended(const Hang&);

}  // namespace roci::scenario
