// How executions of tasks go in the experiments of MEXEC, section V.A.
#pragma once

#include <cstdint>
#include <string>

#include "rehearsal/task_level/task_flight.hpp"

namespace roci::bench::europa {

/// Says what executions are drawn from.
struct Odds {
  double bias = 0;            ///< share by which tasks take more energy than modelled, on the average
  double noise = 0;           ///< standard deviation of that, as a share
  double fail = 0;            ///< of one execution
  double flexible_share = 0;  ///< of failures, that flexible execution can resolve
  double replanning_share_of_rest = 0;  ///< of the others
};

/// Returns how the n-th execution of a task goes, a function of its arguments alone: every strategy meets the same world. Energy is drawn
/// from a normal distribution and is at least a fifth of what is modelled.
rehearsal::task_level::Fate fate(const Odds& odds, std::uint64_t seed, const std::string& task,
                                 std::uint32_t execution);

/// Returns a number in [0, 1) that depends on its arguments alone.
double draw(std::uint64_t seed, const std::string& what, std::uint32_t which);

}  // namespace roci::bench::europa
