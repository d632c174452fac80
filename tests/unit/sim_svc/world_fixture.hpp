// Small worlds for the tests of sim_svc, and what their outputs say.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim_svc/world.hpp"

namespace roci::sim {

/// 120 x 120 m at 0 m without a rock.
std::shared_ptr<const terrain::Site> flat_site();
/// 120 x 120 m rising towards the east by `grade`.
std::shared_ptr<const terrain::Site> ramp_site(double grade);

/// At (20, 20), heading east, arm stowed, 500 kJ, no noise from the sun, window open in [1000, 2000) s.
WorldSetup flat_setup();

Request execute(const std::string& activity, const std::string& component, const std::string& command,
                std::map<std::string, std::string> arguments = {}, std::uint64_t epoch = 1);
Request drive_to(const std::string& activity, const std::string& place, double x, double y);

std::optional<Ack> last_ack(const std::vector<Output>&, const std::string& activity);
std::optional<Value> last_value(const std::vector<Output>&, const std::string& timeline);
double last_number(const std::vector<Output>&, const std::string& timeline);
void append(std::vector<Output>& to, std::vector<Output> more);

/// A world with everything it ever said.
struct Flight {
  explicit Flight(WorldSetup setup, std::uint64_t seed = 1);

  void advance(Time);
  void command(Time, const Request&);
  /// Commands a drive and answers its wish for a path with a straight line.
  void drive(Time, const std::string& activity, const std::string& place, double x, double y);
  /// Commands a motion and answers with a straight joint trajectory of `duration_s`.
  void move_arm(Time, const std::string& activity, const std::string& from, const std::string& to,
                std::vector<double> target, double duration_s);
  Stage stage(const std::string& activity) const;
  std::string code(const std::string& activity) const;
  Time time_of(const std::string& activity) const;
  State state(const std::string& timeline) const;

  World world;
  std::vector<double> joints = {0, 0, 0, 0, 0};
  std::vector<Output> said;
};

}  // namespace roci::sim
