// This is an arm with five joints, a cutter and a drill, which digs trenches and brings samples from them to a
// laboratory.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/components/excavation.hpp"
#include "sim_svc/components/phased_component.hpp"
#include "sim_svc/world/capabilities.hpp"
#include "sim_svc/world/cold_part.hpp"
#include "sim_svc/world/random_stream.hpp"

namespace roci::sim::components {

using ArmJoints = std::array<double, 5>;  ///< rad

/// Describes a place where a trench may be dug.
struct SamplingSite {
  Ice ice;
  double jams_per_h = 0;                   ///< of cutting, on average
  ArmJoints joints{0, 0.2, 1.0, -1.2, 0};  ///< of the arm over the site
};

/// Holds the settings of a sampling arm (README.md); noise is a standard deviation, as a share.
struct SamplingArmSettings {
  std::string zone;  ///< thermal zone of the robot in which it works; empty: it is always warm
  std::map<std::string, SamplingSite> sites;
  std::vector<std::string> targets;   ///< of each site; empty: any
  double depth_m = 0.1;               ///< of an excavated trench
  Cutter cutter{120, 0.03};           ///< 2 GJ/m³ make 14 h of it
  double specific_energy_j_m3 = 2e9;  ///< of the ice for which collect_s holds
  double cutter_efficiency = 0.6;     ///< share of the cutter's power that comes to the ice
  double give_up_s = 1800;            ///< how long it tries where nothing gives way
  double prepare_s = 1200;            ///< calibrates joints and tools, once warm
  double collect_s = 18000;           ///< drills, in ice of specific_energy_j_m3; in harder ice longer
  double transport_s = 3000;          ///< hands over, at the inlet
  double discard_s = 1500;            ///< empties and brushes the tool
  double duration_noise = 0.05;
  double duration_factor = 1;  ///< of all durations but the cutting
  double arm_w = 60;           ///< joints and electronics
  double prepare_w = 0;        ///< beside the arm, while it calibrates: heaters of the links
  double transfer_w = 0;       ///< beside the arm, while it hands over
  double drill_w = 110;        ///< beside the arm, while it drills
  double power_noise = 0.05;
  double waste_share = 0.3;  ///< of what it draws, left as heat in its zone
  /// Lists by command what it warms beside the zone, which is part of its duration and its power.
  std::map<std::string, world::ColdPart> warms{};
  double joint_speed_rad_s = 0.01;
  ArmJoints rest{0, -1.5, 2.6, 0.5, 0};
  ArmJoints inlet{1.6, -1.0, 1.9, 0.7, 0};
  ArmJoints dump{-1.6, -0.7, 1.4, 0.9, 0};
};

/// Simulates a sampling arm. It takes prepare, excavate (site), collect (site, target), transport and discard; each
/// warms the zone first, moves the arm and works. After prepare, which comes before all else and may come again, the
/// tool is empty. What is dug stays dug, whatever becomes of the task; a trench that has its depth already is done at
/// once. It fails `stuck` where the cutter jams and `too-hard` where the ice gives way no more, and refuses what makes
/// no sense: `not-prepared unknown-site unknown-target not-excavated not-empty no-sample too-cold`.
class SamplingArm final : public PhasedComponent, public world::SampleCarrier {
 public:
  SamplingArm(SamplingArmSettings, world::RandomStream noise);

  std::vector<world::CommandForm> commands() const override {
    return {{"prepare", {}},
            {"excavate", {"site"}},
            {"collect", {"site", "target"}},
            {"transport", {}},
            {"discard", {}}};
  }
  std::vector<world::StateForm> state_forms() const override {
    return {{"rests"},         {"ready"},    {"preparing"}, {"digging", 1},
            {"collecting", 2}, {"carrying"}, {"discarding"}};
  }
  std::vector<world::ThingForm> thing_forms() const override {
    return {{"site", {{"untouched"}, {"excavated"}}}};
  }
  std::vector<world::NamedForm> named_forms() const override {
    return {{"sample", {{"none"}, {"held", 2}, {"delivered", 2}}}};
  }
  temporal::State state() const override;
  std::optional<world::SampleOrigin> delivered() const override { return delivered_; }

  world::Ending begin(const world::Task&, temporal::Time now, world::Surroundings&) override;
  world::Ending finish(world::Surroundings&) override;
  void halt(temporal::Time now, world::Surroundings&) override;
  std::optional<std::string> spared_from(const world::Mishap&) const override;
  /// Suffers a mishap; a trench under the cutter goes on from the depth that is left.
  void suffer(const world::Mishap&, temporal::Time now, world::Surroundings&) override;
  void settle(temporal::Time now, world::Body&) override;

  /// Returns site.<site> (untouched, excavated) of all sites, and sample (none, held, delivered).
  std::vector<world::NamedState> states() const override;
  std::optional<std::uint64_t> states_version() const override { return version_; }
  /// Returns q0 … q4 in rad, and depth_<site> in m.
  std::vector<world::NamedNumber> numbers() const override;
  bool moves() const override;
  /// Returns depth_m of the trench that was dug or sampled, as it was told.
  std::map<std::string, temporal::Value> results() const override { return results_; }
  world::Memory memory() const override;
  void restore(const world::Memory&) override;

 private:
  struct Run {
    std::string command;
    world::SampleOrigin where;  // of what it works on; excavate has no target
    ArmJoints from{}, to{};
    double power_factor = 1;
    double jam_in_s = 0;                     // of cutting
    double depth_before_m = 0;               // of the trench, when the task began
    double cut_from_m = 0;                   // when the cutting began
    std::optional<std::size_t> cut_phase{};  // once it cuts
  };
  struct Trench {
    IceColumn ice;
    double depth_m = 0;
  };

  world::Ending refusal_of(const world::Task&) const;
  bool excavated(const Trench& trench) const { return trench.depth_m >= settings_.depth_m; }
  std::vector<Phase> phases_of(const Run&, double duration_noise) const;
  Phase work(double seconds, double power_w) const;
  // Makes the work as much longer and dearer as what it warms takes more than usually. Returns false where that cannot
  // be warmed.
  bool add_warming(const Run&, double duration_noise, const world::Body&, Phase& work) const;
  double cutting_w() const;
  // Cuts the trench from where it is, until it is done, jams, or gives way no more.
  std::vector<Phase> cutting();
  world::Ending end_of_cutting();
  void take_effect(const Run&);

  SamplingArmSettings settings_;
  std::map<std::string, Trench> trenches_;
  world::RandomStream noise_;
  std::optional<Run> run_;
  std::map<std::string, temporal::Value> results_;
  bool prepared_ = false;
  ArmJoints joints_;
  std::optional<world::SampleOrigin> held_, delivered_;
  std::uint64_t version_ = 0;  // of states()
};

}  // namespace roci::sim::components
