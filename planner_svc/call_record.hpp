// Call records keep the newest planning calls of a run as files, so that its engine alone can make them again
// (R41). With temporal_pddl:
//   roci-plan DOMAIN planner_calls/3.pddl --functions planner_calls/3.values --remaining
//   planner_calls/3.remaining
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/engine/answer.hpp"

namespace roci::planner {

/// Writes records of calls into a folder, and removes the oldest beyond kKept. A failure to write ends no
/// mission.
class CallRecords {
 public:
  /// Bounds the calls that are kept; one of a long mission takes some 10 kB.
  static constexpr std::size_t kKept = 250;

  /// Keeps nothing if the path is empty. The folder is made with the first call; numbers go on after those
  /// that are there already.
  explicit CallRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the engine's own record of the call, N with each of its endings, and N.json: verdict, reason, wall_s,
  /// evaluated, expanded, function_requests, function_tuples, exact_values, from_remaining, actions. What cannot be
  /// written is left out.
  void keep(const engine::Answer& answer, double wall_s);

 private:
  void take_in(const std::filesystem::path& file);
  void look_through_folder();

  std::filesystem::path folder_;
  bool looked_ = false;
  std::map<int, std::vector<std::filesystem::path>> calls_;  // the files of each, by its number
};

}  // namespace roci::planner
