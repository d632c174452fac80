// A camera that takes images of the ground ahead; the images are data products on board until a radio sends them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a camera (README.md); noises are standard deviations, as shares.
struct CameraSettings {
  double duration_s = 38.5;
  double duration_noise = 0.02;
  double power_w = 15;
  double image_bytes = 1400000;
  double bytes_noise = 0.03;
  double image_noise = 0.02;  ///< standard deviation of a pixel, as a share of white
};

/// Is a camera on a body that stands on the ground: image (image) takes a picture of what lies ahead, which
/// is on board when it is done. The body stands still meanwhile.
class Camera final : public world::Component, public world::BodyInterlock {
 public:
  Camera(CameraSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override { return {{"image", {"image"}}}; }
  std::vector<world::StateForm> state_forms() const override { return {{"idle"}, {"imaging"}}; }
  std::vector<world::ThingForm> thing_forms() const override { return {{"image", {{"stored"}, {"sent"}}}}; }
  /// Returns idle or imaging.
  temporal::State state() const override;
  bool busy() const override { return shot_.has_value(); }
  world::Ending forbids_driving() const override;

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time, world::Surroundings&) override { shot_.reset(); }

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return busy() ? settings_.power_w : 0; }
  /// Returns the bytes of the image.
  std::map<std::string, temporal::Value> results() const override { return {{"bytes", last_bytes_}}; }

 private:
  struct Shot {
    std::string image;
    std::string source;
    temporal::Time end{};
  };

  CameraSettings settings_;
  std::optional<Shot> shot_;
  double last_bytes_ = 0;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
