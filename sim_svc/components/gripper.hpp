// This is a gripper that picks samples up and drops them, at the places and poses where that is possible.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/component.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

/// Holds the settings of a gripper (README.md); the noise is a standard deviation, as a share.
struct GripperSettings {
  double pick_s = 58;
  double drop_s = 29;
  double duration_noise = 0.03;
  double power_w = 15;
  std::string pick_pose = "sampling";  ///< is a pose of the arm, where there is one
  std::string drop_pose = "deposit";
};

/// Simulates a gripper: it takes pick (sample, place) and drop (sample, place). A sample that nobody touched
/// lies where the first pick looks for it. The body, if it can drive, stands at the place; the arm, if there
/// is one, is at the pose; both rest while it works.
class Gripper final : public world::Component,
                      public world::SampleHolder,
                      public world::BodyInterlock,
                      public world::ManipulatorInterlock {
 public:
  Gripper(GripperSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override {
    return {{"pick", {"sample", "place"}}, {"drop", {"sample", "place"}}};
  }
  std::vector<world::StateForm> state_forms() const override {
    return {{"empty"}, {"holding", 1}, {"working"}};
  }
  std::vector<world::ThingForm> thing_forms() const override {
    return {{"sample", {{"in-place", 1}, {"held"}, {"dropped", 1}}}};
  }
  /// Returns empty, holding (sample) or working.
  temporal::State state() const override;
  bool busy() const override { return work_.has_value(); }
  std::optional<std::string> held() const override { return held_; }
  world::Ending forbids_driving() const override { return at_work(); }
  world::Ending forbids_reaching() const override { return at_work(); }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  std::optional<temporal::Time> next_change() const override;
  world::Ending finish(world::Surroundings&) override;
  /// Opens (pick) or keeps hold (drop), so that all is as before the work.
  void halt(temporal::Time, world::Surroundings&) override { work_.reset(); }

  double energy_j(temporal::Time from, temporal::Time to) const override;
  double peak_power_w() const override { return busy() ? settings_.power_w : 0; }
  /// Returns in-place (place), held or dropped (place) as sample.<name>, for each sample that it touched.
  std::vector<world::NamedState> states() const override;
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  struct Work {
    bool pick = true;
    std::string sample;
    std::string place;
    temporal::Time end{};
  };
  world::Ending at_work() const;
  world::Ending begin_pick(const world::Task&, world::Environment&);
  world::Ending begin_drop(const world::Task&) const;

  GripperSettings settings_;
  std::optional<std::string> held_;
  std::optional<Work> work_;
  std::map<std::string, temporal::State> samples_;
  world::RandomStream noise_;
};

}  // namespace roci::sim::components
