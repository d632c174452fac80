// Keeps every planning call of a run as files, so that its engine alone can make it again (R41). Of
// temporal_pddl:
//   roci-plan DOMAIN planner_calls/3.pddl --functions planner_calls/3.values --remaining
//   planner_calls/3.remaining
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "planner_svc/engine/answer.hpp"

namespace roci::planner {

class CallRecords {
 public:
  /// An empty path: nothing is kept. The folder is made with the first call; numbers go on after those that
  /// are there already.
  explicit CallRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Writes the engine's own record of the call, N with each of its endings, and N.json: verdict, reason,
  /// wall_s, evaluated, expanded, from_remaining, actions. What cannot be written is left out: a record is no
  /// reason to end a mission.
  void keep(const engine::Answer& answer, double wall_s);

 private:
  std::filesystem::path folder_;
  int last_ = 0;
};

}  // namespace roci::planner
