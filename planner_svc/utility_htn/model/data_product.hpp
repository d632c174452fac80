// Data products are data that a mission generates, in a form that the search, the Downlink Manager and the
// delivery share.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/rank_vector.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {

/// Describes data that wait on board, or that a planned task is predicted to generate. It is sent whole, with one
/// downlink.
struct DataProduct {
  std::string id;  ///< unique among those of a question; of a planned task "request/task/product"
  Tier tier = Tier::mandatory;
  std::uint64_t bytes = 0;
  /// Gives the time at which the task that generates it ends; no downlink that starts before takes it.
  temporal::Time created{0};
  temporal::RankVector utility{};  ///< scores ≥ 0
  friend bool operator==(const DataProduct&, const DataProduct&) = default;
};

}  // namespace roci::planner::utility_htn::model
