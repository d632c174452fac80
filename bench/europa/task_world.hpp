// The world at the level of tasks for the experiments of MEXEC, section V.A (R121):
// what an execution of a task takes, and whether it fails.
#pragma once

#include <cstdint>
#include <string_view>

#include "planner_svc/utility_htn/strategies/equations.hpp"

namespace roci::bench::europa {

/// Names the cheapest mechanism that can resolve a failure (section II.C);
/// each can resolve what those before it can, too.
enum class Resolution { none, flexible, replanning, ground };

/// Says how one execution of a task goes, relative to what the network has of it.
struct Fate {
  double duration = 1;  ///< factor
  double energy = 1;    ///< factor of all that the task draws from the budget
  Resolution failure = Resolution::none;
};

/// Describes a world. Its draws depend on nothing but the seed, the task and how often that was executed before, so
/// that all strategies meet the same world, whatever they do first.
struct TaskWorld {
  std::uint64_t seed = 1;
  double bias = 0;         ///< the mean energy is the model's × (1 + bias)
  double deviation = 0.1;  ///< standard deviation of the energy, as a share of the model's
  planner::utility_htn::strategies::FailureProbabilities failures =
      planner::utility_htn::strategies::split(0.1, 0.3, 0.6);
};

/// Returns the fate of a task's n-th execution, counted from 0. Its duration is that of the network; energy and
/// failure are independent of each other and of all other executions.
Fate fate(const TaskWorld& world, std::string_view task, std::uint32_t execution);

}  // namespace roci::bench::europa
