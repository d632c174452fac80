// This is a camera that looks for the marker of another robot and works out from it where that robot stands.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a marker camera (README.md); noises are standard deviations.
struct MarkerCameraSettings {
  double duration_s = 5;
  double power_w = 15;
  double mast_m = 1.5;         ///< of the camera, above the ground
  double marker_m = 0.4;       ///< of the marker, above the ground under the other robot
  double least_range_m = 0.5;  ///< nearer than that it is out of focus
  double most_range_m = 8;     ///< farther than that it has too few pixels
  double view_deg = 90;        ///< width of the field of view, which looks ahead
  double miss_share = 0.02;    ///< of the images in which a marker that is there is not found
  double range_noise = 0.02;   ///< of the place, as a share of the range
  double heading_noise_rad = 0.05;
  std::string light{};  ///< timeline of the window in which anything is seen; empty: always
};

/// Says why a camera at `from` does not see a marker at `to`; empty: it does. Ground, the rocks of the map and hidden
/// ones hide it.
std::string why_unseen(const world::Ground&, const MarkerCameraSettings&, const world::Pose& from,
                       const world::Pose& to);

/// Simulates a camera for markers: localise (robot) looks for the one of that robot. The body stands still meanwhile.
/// Results are `x`, `y` (m) and `heading` (rad) of the other robot; where its marker is not seen the task fails
/// `marker-not-seen`.
class MarkerCamera final : public world::Component, public world::BodyInterlock {
 public:
  MarkerCamera(const MarkerCameraSettings&, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return {{"localise", {"robot"}}}; }
  std::vector<world::StateForm> state_forms() const override { return {{"idle"}, {"looking"}}; }
  temporal::State state() const override;
  std::vector<std::string> awaited_windows() const override;
  bool busy() const override { return look_.has_value(); }
  world::Ending forbids_driving() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time, world::Surroundings&) override { look_.reset(); }

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return busy() ? settings_.power_w : 0; }
  std::map<std::string, temporal::Value> results() const override { return results_; }

 private:
  struct Look {
    std::string robot;
    temporal::Time end{};
    bool dark = false;
  };

  MarkerCameraSettings settings_;
  std::optional<Look> look_;
  std::map<std::string, temporal::Value> results_;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
