// This file reads what a mission file says about its planner.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"
#include "planner_svc/engine/table.hpp"

namespace roci::planner {

/// Holds the `planner` section of mission.yaml, with defaults for what is missing.
struct Settings {
  std::string engine;  ///< engine that the mission names; empty: none
  std::string model;   ///< text of the mission's model in that engine's language; empty: the mission has none
  std::filesystem::path model_file{};                           ///< file from which the model was read
  temporal::Duration function_timeout = temporal::seconds(20);  ///< time for one batch of values
  /// Bounds the evaluations that a call may spend on better plans once it has one; see engine::Request.
  std::uint64_t improvement = engine::kImprovement;
  /// Says which values of external functions are asked for: `functions: eager`, `lazy` or `two_accuracy`.
  engine::FunctionsMode functions = engine::FunctionsMode::eager;
  /// Name the ways to search that run side by side, and the number of threads (engine::Request).
  std::vector<std::string> resolvers{};
  std::size_t threads = 1;
  /// Says whether each step of an engine that plans all the time is kept in the run folder (step_records.hpp).
  bool keep_steps = true;
  /// Lists what the ground may change of it in flight: `network`, `parameters`, of the mission's `ground:
  /// {uploads: …}`.
  std::vector<std::string> uploads{};
  /// Give the mission time that a call takes under the simulated clock, in seconds.
  double simulated_base_s = 0.5;
  double simulated_per_evaluation_s = 0.0005;
};

/// Reads `planner` in mission.yaml of the folder, and the text of the file that `model` names there. Throws as
/// mission::Entry does, also for resolvers that the engine of this table does not have.
Settings read_settings(const std::filesystem::path& mission, const engine::Table& table = {});

}  // namespace roci::planner
