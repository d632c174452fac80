// This file reads a robot's power in the mission file: battery, panel, use, gauge.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/world/battery.hpp"

namespace roci::sim::setup {

/// Reads `power` of a robot in mission.yaml (README.md). Throws mission::FileError with place and remedy.
world::PowerParameters read_power(const mission::Entry&);
/// Reads `gauge` of it, which a scenario's `world` may give instead.
world::Gauge read_gauge(const mission::Entry&);

}  // namespace roci::sim::setup
