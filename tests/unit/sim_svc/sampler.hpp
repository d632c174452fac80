// A lander that digs and analyzes for the tests of sim_svc: a sampling arm and a laboratory.
#pragma once

#include <string>

#include "sim_svc/components/laboratory.hpp"
#include "sim_svc/components/sampling_arm.hpp"
#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim {

/// A sampler whose settings a test may change before it builds it. Sites 0 and 1 of 0.1 m, for which the cutter needs
/// 10,000 s each; targets 0 and 1, of which 0_0 alone is positive. Nothing is noisy, everything is warm, and the arm is
/// at each place already.
struct Sampler {
  Sampler();

  components::SamplingArmSettings arm;
  components::LaboratorySettings laboratory;
  world::PowerParameters power;
  double battery_j = 50e6;
  std::optional<world::ThermalParameters> thermal{};
  double data_bytes = 1e9;

  /// Puts arm and laboratory into zones of their names, both at 150 K in surroundings of 100 K.
  void make_cold();
  world::WorldSetup build() const;
};

/// Flies a sampler.
struct SamplerFlight : Flight {
  explicit SamplerFlight(const Sampler& sampler = {}, std::uint64_t seed = 1);

  /// Commands the arm or the laboratory a second after all before, and returns the activity.
  std::string start(const std::string& component, const std::string& command,
                    const std::map<std::string, std::string>& arguments = {});
  /// As start(), and advances until it has ended, a day at most. Returns its code.
  std::string arm(const std::string& command, const std::map<std::string, std::string>& arguments = {});
  std::string analyze(const std::string& site, const std::string& target, const std::string& form = "raw");
  /// Advances by so much.
  void pass(double seconds);
  /// Returns how long the newest task took, in s, and what it used, in J.
  double seconds_taken() const;
  double joules_taken() const;

  temporal::Time now{};
  std::string newest;  ///< activity

 private:
  std::string run(const std::string& component, const std::string& command,
                  const std::map<std::string, std::string>& arguments);
  int count_ = 0;
};

}  // namespace roci::sim
