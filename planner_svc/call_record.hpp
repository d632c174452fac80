// Keeps every planning call of a run as files, so that the planner alone can make it again (R41):
//   roci-plan DOMAIN planner_calls/3.pddl --functions planner_calls/3.values --remaining
//   planner_calls/3.remaining
#pragma once

#include <filesystem>
#include <string>

#include "planner_svc/temporal_pddl/adapter/planning_call.hpp"

namespace roci::planner {

class CallRecords {
 public:
  /// An empty path: nothing is kept. The folder is made with the first call; numbers go on after those that
  /// are there already.
  explicit CallRecords(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// N.pddl: the problem; N.values: the function values that it was given; N.remaining: what remained of an
  /// earlier plan, if anything; N.json: verdict, reason, wall_s, evaluated, expanded, actions. What cannot be
  /// written is left out: a record is no reason to end a mission.
  void keep(const temporal_pddl::adapter::PlanningCall& call,
            const temporal_pddl::adapter::PlanningAnswer& answer, double wall_s);

 private:
  std::filesystem::path folder_;
  int last_ = 0;
};

}  // namespace roci::planner
