// A run picture shows a whole run: what each robot knows of the ground and where it drove, and under it what
// timelines showed when.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ground_console/cli/map/course.hpp"
#include "ground_console/cli/map/mission_map.hpp"

namespace roci::console::cli::map {

/// Holds all that the picture of a run shows.
struct RunPicture {
  std::string title;
  std::string subtitle{};
  std::vector<std::string> robots{};  ///< in the order in which they are shown
  std::optional<MissionMap> map{};    ///< without: the mission has no ground
  Course course{};
};

/// Draws it as an SVG document. Where robots have maps of their own (MissionMap::known), each has a panel with that
/// map, its own way as a strong line and those of the others as thin ones; else one panel shows all. Rows of timelines
/// come below: those of the team, then robot by robot; the state in which a timeline began is pale wherever it stands
/// again, what is still to come has a dashed rim, plans begin at dashed lines, repairs are triangles.
std::string to_svg(const RunPicture& picture);

}  // namespace roci::console::cli::map
