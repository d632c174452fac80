// A planner that knows energies and failures of a flight beforehand and pays for the failures as the flight does
// (MEXEC, section V.A, R121).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/europa/task_flight.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::bench::europa {

/// Is utility that an analysis shows: another target of the same site is worth more than it looked.
struct Discovery {
  std::string parameter;  ///< the worth of that target
  double value = 0;
  double more = 0;  ///< than the prior
};

/// Is all that such a planner knows. What it refers to outlives it.
struct Foreknowledge {
  const planner::utility_htn::model::Network& network;
  Fates fates;
  Costs costs;
  /// Returns what a task shows when it has been executed; may be empty.
  std::function<std::optional<Discovery>(const std::string& task)> discovery{};
  double budget = 0;
};

/// Is what one more success of a task takes.
struct Success {
  double energy = 0;    ///< of the attempt that succeeds
  double recovery = 0;  ///< c_r or c_g, and the attempt that failed
  double seconds = 0;   ///< of both, and of the wait for the ground
};

/// Returns what the first, second, … success of a primitive task takes. A failure that flexible execution or the ground
/// resolves is paid by the same execution again; one that replanning resolves by the next, which does not fail.
/// Resolving is the cheapest there is.
std::vector<Success> successes(const Foreknowledge& known, const planner::utility_htn::model::Task& task,
                               std::size_t count);

/// Is what such a planner brings home.
struct Prescience {
  double utility = 0;     ///< discoveries counted
  double discovered = 0;  ///< of that
  double energy = 0;      ///< of the attempts that succeed
  double recovery = 0;
  double fixed = 0;  ///< requests with a fixed time, as the hotel load
  double tasks = 0;  ///< that command something, and so may fail
  std::vector<std::string> chains;
  bool proven = false;  ///< nothing better exists
};

/// Chooses the chains whose utility at the first rank is greatest, by branch and bound over the requests in the order
/// of the network; among all choices, unless `proven` is false. What a choice takes depends on nothing but how often
/// each task is done, since fates go by task and execution. It keeps the budget, the time that each atomic timeline
/// has, windows of requests and what selects decompositions; it does not place the chains in time. So no flight in the
/// same world that pays for its failures brings home more.
Prescience prescient(const Foreknowledge& known);

}  // namespace roci::bench::europa
