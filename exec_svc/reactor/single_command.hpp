// A single command that the ground gives (autonomy E1; R128) runs as a plan of the ground's own, so that all that
// holds for plans holds for it: results, restarts and the executed plan.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/orders/order.hpp"

namespace roci::exec::reactor {

/// Returns whether a plan is made of single commands.
bool is_of_single_commands(const temporal::FlexiblePlan& plan);

/// Holds the plan that carries a single command out, or says why there is none.
struct SingleCommand {
  temporal::FlexiblePlan plan;
  std::string activity;  ///< activity of the command in the plan
  std::string fault;     ///< in plain words; not empty: there is no plan
};

/// Makes the plan in which an order of kind `command` is carried out: that command, and the single commands that have
/// not ended, which go on, or begin. A component that carries one out takes no other.
SingleCommand plan_of_command(const orders::Order& order, const mission::MissionModel& mission,
                              std::uint32_t version, temporal::Time now,
                              const executive::Executive& executive);

}  // namespace roci::exec::reactor
