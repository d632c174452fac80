// Small worlds for the tests of sim_svc, and what their outputs say.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/owner/command_ledger.hpp"
#include "sim_svc/components/arm.hpp"
#include "sim_svc/components/camera.hpp"
#include "sim_svc/components/drive.hpp"
#include "sim_svc/components/gripper.hpp"
#include "sim_svc/components/radio.hpp"
#include "sim_svc/world/world.hpp"

namespace roci::sim {

/// 120 x 120 m at 0 m without a rock.
std::shared_ptr<const terrain::Site> flat_site();
/// 120 x 120 m rising towards the east by `grade`.
std::shared_ptr<const terrain::Site> ramp_site(double grade);

/// A component that make_shared-like `Part` is, with these settings.
template <class Part, class Settings>
world::ComponentSetup part(const std::string& name, const std::string& type, Settings settings) {
  return {name, type, [settings](world::RandomStream noise) {
            return std::make_unique<Part>(settings, std::move(noise));
          }};
}

/// A rover whose settings a test may change before it builds it.
struct Rover {
  std::string name = "rover";
  components::DriveSettings drive;
  components::ArmSettings arm{{}, "arm_svc", "stow", "arm-here", "stow", {0, 0, 0, 0, 0}};
  components::CameraSettings camera;
  components::GripperSettings gripper;
  components::RadioSettings radio;
  world::PowerParameters power;
  world::Pose start{20, 20, 0};
  double battery_j = 500000;

  world::RobotSetup build() const;
};

/// The rover at (20, 20), heading east, arm stowed, 500 kJ, no sun, window open in [1000, 2000) s.
struct FlatSetup {
  Rover robot;
  world::Ground ground{flat_site(), {}};

  world::WorldSetup build() const;
};
inline FlatSetup flat_setup() { return {}; }

services::owner::Request execute(const std::string& activity, const std::string& component,
                                 const std::string& command,
                                 std::map<std::string, std::string> arguments = {}, std::uint64_t epoch = 1);
services::owner::Request drive_to(const std::string& activity, const std::string& place, double x, double y);

std::optional<temporal::Value> last_value(const world::Outputs&, const std::string& timeline);
double last_number(const world::Outputs&, const std::string& timeline);
/// Returns what was said of data products, in order.
std::vector<world::Product> products_in(const world::Outputs&);
void append(world::Outputs& to, world::Outputs more);

/// A world with everything it ever said, and an owner's ledger before it.
struct Flight {
  explicit Flight(const FlatSetup& setup, std::uint64_t seed = 1) : Flight(setup.build(), seed) {}
  explicit Flight(world::WorldSetup setup, std::uint64_t seed = 1);

  void advance(temporal::Time);
  void command(temporal::Time, const services::owner::Request&);
  void answer(temporal::Time, const std::string& activity, const world::Answer&);
  void disturb(temporal::Time, const world::Disturbance&);
  /// Commands a drive and answers its wish for a path with a straight line.
  void drive(temporal::Time, const std::string& activity, const std::string& place, double x, double y,
             const std::string& robot = "");
  /// Commands a motion and answers with a straight joint trajectory of `duration_s`.
  void move_arm(temporal::Time, const std::string& activity, const std::string& from, const std::string& to,
                std::vector<double> target, double duration_s);

  std::optional<services::owner::Ack> last_ack(const std::string& activity) const;
  services::owner::Stage stage(const std::string& activity) const;
  std::string code(const std::string& activity) const;
  temporal::Time time_of(const std::string& activity) const;
  temporal::State state(const std::string& timeline) const;

  world::World world;
  services::owner::CommandLedger ledger;
  std::vector<double> joints = {0, 0, 0, 0, 0};
  world::Outputs said;
  std::vector<services::owner::Ack> acks;

 private:
  void hear(world::Outputs);
};

}  // namespace roci::sim
