// The shared map is what a robot knows of the terrain beyond the map that was loaded: what it found itself, and
// what others told it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/duration.hpp"
#include "pathplan_svc/costmap.hpp"

namespace roci::pathplan {

/// Says what a disc is: a rock stands in everybody's way, soil was judged not to bear a vehicle of the team.
enum class ObstacleKind : std::uint8_t { rock, soil };

/// Holds the newest word of the robot that found it on one disc that nobody may enter.
struct FoundObstacle {
  std::string finder;  ///< robot; with the id its name for good
  std::string id;
  ObstacleKind kind = ObstacleKind::rock;
  Disc disc;
  bool cleared = false;    ///< it was there, and is no more
  temporal::Time found{};  ///< when this was found
  bool operator==(const FoundObstacle&) const = default;
};

/// Holds all that its author knew beyond the loaded map.
struct MapPatch {
  std::string author;  ///< service
  std::string robot;   ///< that the author belongs to
  /// Incarnation and sequence: which of two of an author is the newer one.
  std::pair<std::uint32_t, std::uint64_t> number;
  std::vector<FoundObstacle> obstacles;
  std::uint64_t map_version = 0;  ///< of the author's map with all of this in it
  temporal::Time told{};          ///< when it was told
};

/// Holds what is remembered of the newest patch of an author that was taken.
struct TakenPatch {
  std::pair<std::uint32_t, std::uint64_t> number;
  std::uint64_t map_version = 0;
  temporal::Time told{};
};

/// Says what became of a patch or a finding.
struct Intake {
  std::string refusal;   ///< empty: it was taken; else why not, and the remedy
  bool changed = false;  ///< an obstacle came, moved or went
};

/// Obstacles by finder and id; of two words on one the later counts, and at one time the one that is greater, member by
/// member. So the same findings give the same map in whatever order, however often and by whomever they are told.
class SharedMap {
 public:
  /// `team` says by service who belongs to which robot; `robot` is the one whose map it is (empty: the team's).
  SharedMap(std::string robot, const terrain::Grid&, std::map<std::string, std::string> team);

  /// Takes what the robot has found itself.
  Intake find(const FoundObstacle&);
  /// Takes a patch, whole or not at all. Refused are: an author that is no service of the team, a patch older than one
  /// of its author that was taken, an obstacle that is not finite, off the map or larger than it, and what finds no
  /// room. On what this robot has found itself nobody else has a say.
  Intake take(const MapPatch&);

  /// Returns the newest patch of the author that was taken, or null.
  const TakenPatch* newest(const std::string& author) const;

  /// Returns what is known, in order of finder and id.
  std::vector<FoundObstacle> all() const;
  /// Returns those that are there.
  std::vector<Disc> discs() const;

  /// Bounds what is known; a patch holds no more, either.
  static constexpr std::size_t kMost = 500;
  /// Bounds the bytes of a robot's name, and of an id.
  static constexpr std::size_t kNameBytes = 128;

 private:
  using Key = std::pair<std::string, std::string>;
  std::string fault_of(const FoundObstacle&) const;
  bool merge(const FoundObstacle&);

  std::string robot_;
  terrain::Grid grid_;
  std::map<std::string, std::string> team_;
  std::map<Key, FoundObstacle> known_;
  std::map<std::string, TakenPatch> newest_;  // by author
};

}  // namespace roci::pathplan
