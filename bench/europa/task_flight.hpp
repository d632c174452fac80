// Flies a task network in process at the level of tasks (MEXEC, section V.A): the engine and the executive are those of
// flight, the world knows no more of a task than how long it takes,
// what it draws from the budget, and whether it fails.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/europa/projection.hpp"
#include "bench/europa/task_world.hpp"
#include "core/temporal/rank_vector.hpp"
#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::bench::europa {

/// Returns the fate of the n-th execution of a task, counted from 0. It depends on nothing else,
/// so that strategies meet the same world.
using Fates = std::function<Fate(const std::string& task, std::uint32_t execution)>;

/// Names the strategies of section III.D (R102).
enum class Strategy { as_planned, ground, flexible_execution, replanning };

/// Says what resolving a failure takes.
struct Costs {
  double replanning_j = 0;
  double ground_j = 0;
  temporal::Duration ground_wait{0};  ///< until the ground has resolved it
};

/// Describes one flight.
struct Flight {
  const planner::utility_htn::model::Network& network;
  planner::engine::SteppedEngine& engine;
  Fates fates;
  Strategy strategy = Strategy::replanning;
  Costs costs{};
  temporal::Time until = temporal::no_bound;
  /// Is told of every task that has succeeded, before the engine hears of it; may be empty.
  std::function<void(const std::string& task)> succeeded{};
  /// Returns seconds of the thread's processor time; where it is given, Flown tells what each step took.
  std::function<double()> processor_time{};
  /// Then Flown tells what is projected, and when `look_for` could start.
  std::optional<temporal::Time> look_at{};
  std::vector<std::string> look_for{};
};

/// Is the utility that was reached when so much was spent (figures 10 and 11).
struct Reached {
  double spent = 0;
  temporal::RankVector utility;
  std::string chain;  ///< that was completed
};

/// Is one attempt of a task as it went (figures 5 and 8).
struct Execution {
  std::string task;
  std::string chain;        ///< of which it was a link
  std::uint32_t block = 0;  ///< of that chain
  temporal::Time start{0};
  temporal::Time end{0};
  double spent = 0;    ///< from the budget
  std::string result;  ///< "done", "failed", "by ground", or "cut off" by the end of the flight
};

/// Says where a flight's energy went; the sum is what was spent.
struct Energy {
  double completed = 0;   ///< attempts that succeeded, of chains that were completed
  double recovering = 0;  ///< c_r, c_g, and failed attempts in chains that were completed
  double broken_off = 0;  ///< chains that were not completed
  double fixed = 0;       ///< requests with a fixed time, as the hotel load
};

/// Says what one step of the engine took.
struct EngineStep {
  temporal::Time at{0};
  double seconds = 0;
  bool cycle = false;    ///< the planning cycle ran; otherwise the engine only listened
  std::size_t done = 0;  ///< parts of the cycle that had something to do
  std::uint64_t explored = 0;
  bool sent = false;  ///< a version came of it
};

/// Says how a flight went.
struct Flown {
  temporal::Time end{0};
  std::string ended_by;          ///< "budget", "failure", "nothing left", "time"
  double spent = 0;              ///< from the budget
  temporal::RankVector utility;  ///< of what was executed to its end (R90)
  std::vector<Reached> course;   ///< after each block that was completed
  std::uint32_t tasks = 0;       ///< executions that succeeded
  std::uint32_t failures = 0;    ///< by what resolved them:
  std::uint32_t retried = 0;
  std::uint32_t replanned = 0;
  std::uint32_t by_ground = 0;
  std::uint32_t versions = 0;
  std::vector<std::string> faults;    ///< versions that the executive would refuse, and why; none is expected
  std::vector<Execution> executions;  ///< by start
  Energy energy;
  std::uint64_t decisions = 0;    ///< hash of all versions that came: equal ones mean equal decisions
  std::vector<EngineStep> steps;  ///< of the engine, if there is a processor_time
  std::optional<Seen> seen;       ///< at the first cycle from Flight::look_at on
  std::vector<double> events;     ///< seconds that each step of the executive took, likewise
};

/// Flies until the budget is spent, nothing is left to do, a failure ends it (as_planned), or `until`.
Flown fly(const Flight& flight);

}  // namespace roci::bench::europa
