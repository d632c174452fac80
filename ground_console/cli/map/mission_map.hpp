// A mission map is what a map of a mission shows. It consists of plain values, whatever they came from.
#pragma once

#include <filesystem>
#include <istream>
#include <map>
#include <string>
#include <vector>

#include "core/terrain/site.hpp"

namespace roci::console::cli::map {

/// Names a place on the map.
struct NamedPlace {
  std::string name;
  terrain::Point at;
};

/// Describes an obstacle or a zone, in metres.
struct Circle {
  terrain::Point centre;
  double radius = 0;
  bool operator==(const Circle&) const = default;
};

/// Holds what a robot's own map has beyond the loaded one.
struct KnownObstacle {
  Circle disc;
  std::string kind;  ///< "rock", "soil"; empty: nobody says
  std::string found_by;
  std::string id;
};

using Way = std::vector<terrain::Point>;

/// Holds all that a map of a mission shows.
struct MissionMap {
  terrain::Site site;
  std::string title;
  std::string subtitle{};  ///< says which run and when
  std::vector<NamedPlace> places{};
  std::vector<Circle> hazards{};
  std::map<std::string, std::vector<KnownObstacle>> known{};  ///< by robot; of robots with a map of their own
  std::vector<Circle> keep_out_discs{};
  std::vector<terrain::Polygon> keep_out{};
  std::vector<Way> planned{};           ///< as the path planner leads
  std::vector<Way> planned_legs{};      ///< of which only the ends are known
  std::map<std::string, Way> driven{};  ///< by robot, oldest first
};

/// Reads site, keep-out zones and the objects with a fixed place of mission.yaml. Throws mission::FileError or
/// terrain::MapError with the remedy, std::invalid_argument where the mission has no site.
MissionMap read_mission_map(const std::filesystem::path& folder_or_file);

/// Adds what a run left: `trace` is the text of `roci-trace print` (docs/formats.md). A robot is whatever observes its
/// `<name>.x` and `<name>.y`; the places of the newest plan are those that its activities name by x and y. Lines that
/// say neither are passed over.
void add_trace(std::istream& trace, MissionMap& map);

/// Adds the place unless one lies there already; then the name is joined to that one's, if it is another.
void add_place(std::vector<NamedPlace>& places, const NamedPlace& place);

}  // namespace roci::console::cli::map
