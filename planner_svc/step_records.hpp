// Keeps what an engine that plans all the time hears, as files of the run folder, so that the engine alone can make its
// steps again (R66, engine/step_record.hpp). Of utility_htn:
//   roci-network cycle planner_steps/1.steps
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "planner_svc/engine/step_record.hpp"

namespace roci::planner {

/// Keeps the steps of an engine that plans all the time as files of the run folder, within bounds.
class StepRecords {
 public:
  struct Bounds {
    std::size_t records = 20;              ///< one for each engine that was made, the newest
    std::uintmax_t bytes = 128ULL << 20U;  ///< of one record; 22 days of the Europa lander take 4 MB
    std::uintmax_t together = 256ULL << 20U;
  };

  /// An empty path: nothing is kept. The folder is made with the first record; numbers go on after those that are there
  /// already.
  explicit StepRecords(std::filesystem::path folder);
  StepRecords(std::filesystem::path folder, const Bounds& bounds);

  /// Begins N.steps for an engine that has just been made, and removes the oldest records beyond the bounds.
  /// What cannot be written is left out: a record is no reason to end a mission.
  void begin(const engine::RecordedEngine& engine);
  /// Is said before the step, so that a step in which the process ends is in the record.
  void heard(const engine::StepInputs& inputs);
  void did(const engine::StepOutcome& outcome);

  /// Returns once, in words, why the record ends here while its engine goes on; else nothing.
  std::string take_end();

 private:
  void look_through_folder();
  void remove_old();
  void write(const std::string& bytes);
  void end(std::string why);

  std::filesystem::path folder_;
  Bounds bounds_;
  bool looked_ = false;
  std::map<int, std::filesystem::path> records_;  // by number
  std::ofstream out_;                             // open: it is written on
  std::uintmax_t written_ = 0;
  std::string ended_;  // to be told
};

}  // namespace roci::planner
