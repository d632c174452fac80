// The experiments of MEXEC, section V.A (R121–R123): one network, one setting of odds and costs,
// flights by strategy and seed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "bench/europa/prescient.hpp"
#include "bench/europa/task_flight.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"

namespace roci::bench::europa {

/// Says what the paper's text fixes and what was chosen (experiments.yaml).
struct Setting {
  double noise = 0;  ///< standard deviation of a task's energy, as a share of the model's
  planner::utility_htn::strategies::FailureProbabilities failures;
  int runs = 50;
  std::vector<double> biases;
  Costs costs;
  double discovery_share = 0;
  double discovery_utility = 0;
  /// What replanning does without: "retry" (what it resolves is planned anew), "repair", "optimize",
  /// "learning", "discovery".
  std::set<std::string> without;
  /// Only the first execution of this task fails, so; everything else goes as the network has it (figure 5).
  std::optional<std::pair<std::string, Resolution>> only_failure;
  std::optional<temporal::Time> look_at;  ///< see Flight
  std::vector<std::string> look_for;
  bool robust = false;     ///< plans are judged by the worst of more, less and predicted energy
  bool downlinks = false;  ///< the Downlink Manager is asked
};

/// Reads experiments.yaml. Throws mission::MissionError with file and line.
Setting read_setting(const std::filesystem::path& file);

/// Flies. All that it refers to outlives it.
class Experiment {
 public:
  Experiment(const planner::utility_htn::model::Network& network, const Setting& setting)
      : network_(network), setting_(setting) {}

  /// Flies until `until`, or the end of the plan if that is sooner; see Flight::processor_time.
  Flown flown(Strategy strategy, double bias, std::uint64_t seed,
              const std::function<double()>& processor_time = {},
              temporal::Time until = temporal::no_bound) const;

  /// Flies so that everything goes as the network has it, on a battery that bears the bias.
  Flown without_failures(double bias) const;

  /// Returns what a planner brings home that knows the world of that bias and seed beforehand;
  /// `without_j` less than the battery holds.
  Prescience prescient(double bias, std::uint64_t seed, double without_j = 0) const;

  /// Returns the fate of a task's n-th execution in the world of that bias and seed.
  Fate fate_of(double bias, std::uint64_t seed, const std::string& task, std::uint32_t execution) const;

  /// Returns what this task's execution shows, if anything. Only an engine that plans anew can use it.
  std::optional<Discovery> discovery(std::uint64_t seed, const std::string& task) const;

 private:
  const planner::utility_htn::model::Network& network_;
  const Setting& setting_;
};

}  // namespace roci::bench::europa
