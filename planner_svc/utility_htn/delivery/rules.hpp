// The rules are what a network says of its downlinks in general: the rate and the limits of energy (R111), as
// parameters of well-known names.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "planner_svc/utility_htn/downlink/manager.hpp"
#include "planner_svc/utility_htn/model/network.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::delivery {

/// Finds the parameters `rate_bytes_per_s`, `downlink_limit_j`, `sol_limit_j` and `sol_s`. A network without a rate has
/// no downlinks to speak of: then all data get home. What else is not there is no limit; a sol is 86,400 s long where
/// the network does not say.
class Rules {
 public:
  explicit Rules(const model::Network& network);

  bool has_rate() const { return rate_.has_value(); }
  double bytes_per_s(const model::Values& values) const { return value(rate_, values, 0); }
  /// Returns the window of a planned downlink. It is as long as the network says that the task takes; a task that takes
  /// no time or has no rate carries nothing.
  downlink::Window window(const search::PlannedDownlink& planned, const model::Values& values) const;
  /// Returns what a transmission as long as the window takes.
  static double joules(const downlink::Window& window);
  double downlink_limit_j(const model::Values& values) const { return value(downlink_limit_, values, kNone); }
  double sol_limit_j(const model::Values& values) const { return value(sol_limit_, values, kNone); }
  std::uint32_t sol_of(temporal::Time time, const model::Values& values) const;
  /// Returns when the sol after this one begins.
  temporal::Time end_of_sol(std::uint32_t sol, const model::Values& values) const;

 private:
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  static double value(std::optional<model::ParameterIndex> parameter, const model::Values& values,
                      double otherwise);

  const model::Network* network_;
  std::optional<model::ParameterIndex> rate_, downlink_limit_, sol_limit_, sol_length_;
};

}  // namespace roci::planner::utility_htn::delivery
