// This is a camera that takes images of the ground ahead; the images are data products on board until a radio
// sends them.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/preview.hpp"
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
  View view;
  double panorama_every_s = 0;  ///< seconds between panoramas; 0: none
  int panorama_views = 6;       ///< views of a panorama, evenly around; 1 … kMostViews
};

inline constexpr int kMostViews = 16;

/// Simulates a camera on a body that stands on the ground: image (image) takes a picture of what lies ahead, which is
/// on board when it is done. The body stands still meanwhile. Of its own accord it takes a panorama at intervals, as
/// soon as the body stands and it takes no other picture: its views (Image::kind `panorama`) show what lies all around,
/// cost no energy, and are not kept.
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

  std::optional<temporal::Time> next_routine() const override;
  void run_routine(temporal::Time now, bool able, world::Surroundings&) override;

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
  world::Image picture(const std::string& id, const world::Pose&, temporal::Time,
                       const world::Surroundings&) const;
  void take_panorama(temporal::Time, world::Surroundings&);

  double last_bytes_ = 0;
  temporal::Time panorama_due_{};
  bool panorama_waits_ = false;  // for the body to stand
  world::RandomStream noise_;
  world::RandomStream pixels_;
};

}  // namespace roci::sim::components
