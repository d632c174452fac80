// Measured values replace priors (MEXEC, section IV.C.3, R101, R116).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::assessor {

/// Holds what an executed task was measured to take; what was not measured is left out.
struct Measured {
  std::optional<double> duration_s{};
  std::optional<double> energy{};  ///< in the unit of the budget
  std::optional<double> power{};   ///< energy per second, the mean over the task
  /// Holds numbers that its commands brought, by name (R108); nothing: they have not said yet.
  std::optional<std::map<std::string, double>> values{};
};

/// Says which parameters were replaced, and which values were refused.
struct Learned {
  std::vector<model::ParameterIndex> replaced{};
  std::vector<std::string> refused{};  ///< one plain sentence each; these values stay as they were
};

/// Replaces the parameters that the task learns (Task::learns), and no others, by what gives exactly the measured
/// duration, energy or power in later predictions of the task; a site's parameters are its own, so other sites'
/// predictions stay. A value that is not finite or out of the parameter's range is refused. The duration is learned
/// first, since energy depends on it. A parameter that is learned from a value gets this value; one that the commands
/// did not bring is refused, too.
Learned learn(const model::Network& network, model::TaskIndex task, const Measured& measured,
              model::Values& values);

}  // namespace roci::planner::utility_htn::assessor
