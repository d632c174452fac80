// A soil sensor is what a light robot measures soil with while it drives, to say whether a heavier one may
// follow.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/terramechanics.hpp"
#include "sim_svc/world/environment.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Describes one instrument that presses on the ground.
struct SoilInstrument {
  std::string name;
  double ahead_m = 0;    ///< of the body's centre, in the direction of travel
  double beside_m = 0;   ///< to the left of it; negative: to the right
  double every_m = 0.1;  ///< of way it measures once, above 0
  double noise = 0.1;    ///< standard deviation, as a share of what it measures
  bool shears = true;    ///< it measures strength, too, and not only how the soil gives way
};

/// Holds what a body measures and by what it judges.
struct SoilSensorSettings {
  std::vector<SoilInstrument> instruments;  ///< none: it has no such sensor
  std::string judges_for;                   ///< the vehicle's name, for people
  WheeledVehicle vehicle;                   ///< that is to follow
  world::Soil believed;                     ///< the strength that is taken for true where none was measured
  double most_sinkage_share = 0.25;         ///< of the wheel's diameter
  double most_traction_share = 0.75;  ///< of the thrust that the soil can bear (Footing::traction_share)
  double mark_radius_m = 1.5;         ///< of the circle that is marked, from the No-Go onwards
};

/// Gives the verdict that the vehicle must not go there.
struct NoGo {
  terrain::Point at;  ///< point that was measured
  std::string instrument;
  Footing expected;  ///< footing of the vehicle, by the measurement
};

/// Describes a disc on the map.
struct MarkedDisc {
  terrain::Point centre;
  double radius = 0;
};

/// Counts what was measured on one drive.
struct SoilRecord {
  int samples = 0;          ///< on soil that gives way
  double least_margin = 1;  ///< 1: firm; 0 and below: No-Go
};

/// Measures along one drive. A wheel bevameter presses and shears under a wheel, a penetrometer presses ahead of it; of
/// firm ground both say Go. What is measured is the soil's stiffness (k_phi) and, by who shears, its friction, each
/// with log-normal noise; the verdict is the footing of the vehicle on that soil,
/// on the steepest line of the slope there.
class SoilSensor {
 public:
  /// Ignores a No-Go in the discs `known`, where it is no news. All arguments must outlive this object.
  SoilSensor(const SoilSensorSettings&, const std::vector<MarkedDisc>& known, world::RandomStream& noise);

  /// Measures what is due after `moved_m` more metres, the last of them to this pose. Returns the first No-Go.
  std::optional<NoGo> sense(const world::Ground&, const world::Pose&, double moved_m);
  const SoilRecord& record() const { return record_; }

 private:
  std::optional<NoGo> measure(const SoilInstrument&, const world::Ground&, terrain::Point);

  const SoilSensorSettings& settings_;
  const std::vector<MarkedDisc>& known_;
  world::RandomStream& noise_;
  std::vector<double> due_m_;  // of way, for each instrument
  double way_m_ = 0;
  SoilRecord record_;
};

}  // namespace roci::sim::components
