// One link of a scenario, as data. docs/links.md tells what each setting does.
#pragma once

#include <array>
#include <string>

#include "core/temporal/duration.hpp"
#include "services/link/schedule.hpp"

namespace roci::services::link {

/// The end of a link that is everything on Earth: consoles, and what a scenario sends up.
inline constexpr char kGround[] = "ground";

/// A link joins two ends and is the same in both directions, each of which has its own capacity.
struct Link {
  std::string name;                   ///< It is unique in a scenario.
  std::array<std::string, 2> ends{};  ///< Each is a robot, a service, or kGround.
  Schedule open{};                    ///< When it carries anything at all.
  temporal::Duration light_time{0};   ///< The time that a signal takes, one way.
  double rate_bit_s = 0;              ///< In each direction, for each receiver; 0: no limit.
  double loss = 0;                    ///< The share of the samples that are lost, 0 to 1.
};

}  // namespace roci::services::link
