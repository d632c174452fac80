// The first plan is the one that the planner would begin with; this file also says why what is not in it is
// not (R119), for authors, before anything flies.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::cli {

/// Says what is asked: values that stand in place of priors, by parameter, and what the budget holds if that
/// is not its first value.
struct WhatIf {
  std::map<std::string, double> values{};
  std::map<std::string, double> initial{};  ///< first values of timelines
};

/// Describes a requested task that the first plan holds.
struct PlannedTask {
  std::string chain;
  temporal::Time start{0};
  temporal::Time end{0};
  temporal::RankVector utility{};  ///< in the context of what starts before it
  double cost = 0;                 ///< from the budget
};

/// Describes a requested task that it does not hold, with a sentence for each way to do it.
struct UnplannedTask {
  std::string task;
  std::vector<std::string> why;
};

/// Holds what the first plan has and what it lacks.
struct FirstPlan {
  std::vector<PlannedTask> planned;      ///< by start
  std::vector<UnplannedTask> unplanned;  ///< in the order of the network
  temporal::RankVector utility{};
  double cost = 0;
  double budget = 0;      ///< what there is at the beginning
  bool complete = false;  ///< no order of adding chains gives a better plan
  std::uint64_t explored = 0;
};

/// Plans the whole network from its first values, as the planner does in its first cycle at mission time 0, with the
/// network's exploration bound and its downlinks. Throws std::invalid_argument, with the remedy, for a name that the
/// network does not have and for a value out of its range.
FirstPlan first_plan(const model::Network& network, const WhatIf& asked);

/// Prints what is planned, the sum, and what is not planned and why: of the named tasks every way,
/// of all others the way that is worth most.
std::string plan_text(const model::Network& network, const FirstPlan& plan,
                      const std::vector<std::string>& tasks);
/// Holds `network`, `ranks`, `budget`, `planned`, `unplanned` (`task`, `why`), `utility`,
/// `cost`, `complete`, `explored`.
std::string plan_json(const model::Network& network, const FirstPlan& plan);

}  // namespace roci::planner::utility_htn::cli
