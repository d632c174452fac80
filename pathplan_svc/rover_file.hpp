// This file reads the rover of a mission file, as the path planner needs it.
#pragma once
#include <vector>

#include "core/mission/entry.hpp"
#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/drive_model.hpp"

namespace roci::pathplan {

/// A mission says this of its rover and of the ground it must not enter.
struct Rover {
  RoverLimits limits;
  DriveModel drive;
  std::vector<Disc> keep_out{};
  std::vector<terrain::Polygon> keep_out_polygons{};
};

/// Reads the section `rover` of mission.yaml (README.md lists its keys; each is optional). Throws
/// mission::FileError with place and remedy.
Rover read_rover(const mission::Entry& section);

/// Throws mission::FileError, with place and remedy, where the rover is wider than a Costmap of the grid can bear.
/// `mission` has the keys `rover` (optional) and `site`.
void require_few_cells(const Rover& rover, const terrain::Grid& grid, const mission::Entry& mission);

}  // namespace roci::pathplan
