// A link of a scenario is data. docs/links.md tells what each setting does.
#pragma once

#include <array>
#include <string>

#include "core/temporal/duration.hpp"
#include "services/link/schedule.hpp"

namespace roci::services::link {

/// Names the end of a link that stands for everything on Earth: consoles, and what a scenario sends up.
inline constexpr char kGround[] = "ground";

/// Joins two ends, alike in both directions, each of which has its own capacity.
struct Link {
  std::string name;                   ///< unique in a scenario
  std::array<std::string, 2> ends{};  ///< each is a robot, a service, or kGround
  Schedule open{};                    ///< when it carries anything at all
  temporal::Duration light_time{0};   ///< time that a signal takes, one way
  double rate_bit_s = 0;              ///< bits per second in each direction, for each receiver; 0: no limit
  double loss = 0;                    ///< share of the samples that are lost, 0 to 1
};

}  // namespace roci::services::link
