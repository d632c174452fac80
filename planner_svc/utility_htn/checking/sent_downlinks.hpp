// What downlinks took that are over counts for the limit of their sol, also when their chains have left the plan.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "planner_svc/engine/checker.hpp"
#include "planner_svc/utility_htn/checking/question.hpp"

namespace roci::planner::utility_htn::checking {

/// Remembers the downlinks that were executed, from one version to the next. A process that is started anew knows
/// those of the version that is executed then.
/// One that began longer ago than the network's longest sol lasts is forgotten: nothing planned from now on shares its
/// sol. So its memory does not grow with the flight.
class SentDownlinks {
 public:
  /// Takes in which downlinks of the version, and of the one that it changes, are over.
  void take(const model::Network& network, const engine::CheckedPlan& checked);
  /// Returns all that it remembers with the times that they really had. Those of tasks that the network lacks are left
  /// out.
  std::vector<Step> steps(const model::Network& network) const;

 private:
  struct Sent {
    std::string task;  // a network that replaces another counts its tasks anew
    Step step;
  };
  std::map<std::uint64_t, Sent> sent_;  // by step
};

}  // namespace roci::planner::utility_htn::checking
