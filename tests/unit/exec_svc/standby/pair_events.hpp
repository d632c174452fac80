// What may happen to a pair: goals, recalls, deaths and starts of executives, cuts of links.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "tests/unit/exec_svc/standby/pair_world.hpp"

namespace roci::exec::testing {

inline constexpr standby::Moment kStep = std::chrono::milliseconds(500);
inline constexpr standby::Moment kOldest = std::chrono::seconds(8);  // no rule of a new_pair() counts longer

// How much may happen. In between all may rest for as long as it likes.
struct Bounds {
  int goals = 2, recalls = 1, cuts = 2, kills = 2;
  int pace = 1;  // steps from one event to the next at least; all else happens in every step
};

// A pair that leaves nothing to chance, and leads.
PairWorld new_pair(Bug bug);

// A pair, and what has happened to it.
struct Course {
  PairWorld world;
  int goals = 0, recalls = 0, cuts = 0, kills = 0;
};

struct Event {
  std::string what;  // empty: nothing happens
  std::function<bool(const Course&, const Bounds&)> may;
  std::function<void(Course&)> happen;
};

// The first one is that nothing happens.
const std::vector<Event>& all_events();

}  // namespace roci::exec::testing
