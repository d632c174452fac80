// This file reads stimuli of a scenario that concern a robot's energy, heat and view.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/setup/roster_file.hpp"
#include "sim_svc/world/disturbance.hpp"

namespace roci::sim::scenario {

// These read stimuli that concern a robot's energy, heat and view (README.md, "Scenarios"). They throw
// mission::FileError with place and remedy.

world::EnergyLoss read_energy_loss(const mission::Entry&, const setup::RobotEntry&);
world::EnergyDrop read_energy_drop(const mission::Entry&, const setup::RobotEntry&);
world::SurroundingsChange read_surroundings_change(const mission::Entry&, const setup::Roster&);
world::SuddenHeat read_sudden_heat(const mission::Entry&, const setup::RobotEntry&);
world::RateChange read_rate_change(const mission::Entry&, const setup::RobotEntry&);
/// Reads a disturbance of a window, without checking that there is such a window.
world::ViewBlock read_view_block(const mission::Entry&, temporal::Time at);

}  // namespace roci::sim::scenario
