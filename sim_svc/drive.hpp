#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "core/terrain/site.hpp"
#include "sim_svc/parameters.hpp"
#include "sim_svc/random_stream.hpp"
#include "sim_svc/values.hpp"

namespace roci::sim {

/// A boulder that no map shows.
struct Rock {
  double x = 0;
  double y = 0;
  double radius = 0;
};

/// The true ground.
struct Ground {
  std::shared_ptr<const terrain::Site> site;
  std::vector<Rock> hidden_rocks;
};

enum class DriveEnd { arrived, blocked, stuck, collision };

struct DriveSample {
  Pose pose;
  double energy_j = 0;            ///< used since the start of the drive
  std::size_t next_waypoint = 0;  ///< index into the way-points
};

/// A whole drive as it happens if nobody interrupts it. Sample i holds at start + i * kDriveStep; the last
/// one at `end`.
struct DriveTrace {
  Time start{};
  Time end{};
  std::vector<DriveSample> samples;
  DriveEnd outcome = DriveEnd::arrived;
  std::optional<std::size_t> seen_rock;  ///< with `blocked`: index into Ground::hidden_rocks
  double peak_power_w = 0;

  /// Between two samples: linear. Before the start the first, after the end the last sample.
  DriveSample at(Time) const;
};

inline constexpr Duration kDriveStep{100000};

/// Integrates the rover along the way-points: point turns, speed by slope, slip by pitch and noise, drift of
/// the heading, electrical energy. `way` has at least one point; `first` is the index of the one it heads
/// for.
DriveTrace simulate_drive(const Ground&, const DriveParameters&, Time start, const Pose& from,
                          const std::vector<terrain::Point>& way, std::size_t first, RandomStream& noise);

}  // namespace roci::sim
