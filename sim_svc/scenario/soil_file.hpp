// This file reads soils and where they lie, as mission and scenario files say it.
#pragma once
#include "core/mission/entry.hpp"
#include "sim_svc/world/soil.hpp"

namespace roci::sim::scenario {

/// Reads `soils`, `soil_areas` and `scattered_soil` of a section `surface` (README.md). A soil of a name that is known
/// stands in place of that one; the two lists are replaced as a whole. Throws mission::FileError with place and remedy,
/// also for a soil that nobody described.
void read_soil(const mission::Entry& surface, world::SoilLayer&);

/// Reads `{soil, x, y, radius}` or `{soil, outline: {polygon}}`; the name is not looked up.
world::SoilArea read_soil_area(const mission::Entry&);

/// Complains of a soil that the layer does not describe.
void check_soil(const std::string& name, const mission::Entry& where, const world::SoilLayer&);

}  // namespace roci::sim::scenario
