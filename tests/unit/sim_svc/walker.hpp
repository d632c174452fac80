// A robot in orbit for the tests of sim_svc: an arm with dynamics on a rail, and a grapple before slots and modules.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim_svc/components/dynamic_arm.hpp"
#include "sim_svc/components/grapple.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim {

/// rail, shoulder, elbow, wrist; 2.2 m from shoulder to tool.
std::shared_ptr<const kinematics::Arm> rail_arm();

/// A walker whose settings a test may change before it builds it: slots s0 … s3 at poses of their names, m0 in s0 and
/// m1 in s1, 80 kg each, sunlight in [0, 1000) and [2000, 3000) s. It starts at pose home; nothing is noisy.
struct Walker {
  Walker();

  components::DynamicArmSettings arm;
  components::GrappleSettings grapple;
  world::PowerParameters power;
  double battery_j = 900000;

  world::WorldSetup build() const;
};

/// Flies a walker; its poses are joints of the rail and the elbow.
struct WalkerFlight : Flight {
  explicit WalkerFlight(const Walker& walker = {}, std::uint64_t seed = 1);

  /// Moves the arm along a straight course to the pose and advances until it rests. Returns how long that took, in s.
  double move(const std::string& from, const std::string& to, double course_s = 6);
  /// Commands the grapple; `latest_s` 0: without a latest end.
  void work(temporal::Time at, const std::string& activity, const std::string& command,
            const std::string& slot, const std::string& module = "", double latest_s = 0);
  /// As work(), a second after all before, and advances until it has ended. Returns its code.
  std::string done(const std::string& command, const std::string& slot, const std::string& module = "");

  temporal::Time now{};

 private:
  int count_ = 0;
};

/// Where the joints are at a pose of the walker.
std::vector<double> joints_at(const std::string& pose);

}  // namespace roci::sim
