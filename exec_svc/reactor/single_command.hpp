/// A single command that the ground gives (autonomy E1; R128): it runs as a plan of the ground's own, so that all that
/// holds for plans holds for it, results, restarts and the executed plan among them.
#pragma once

#include <cstdint>
#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "exec_svc/orders/order.hpp"

namespace roci::exec::reactor {

/// Whether a plan is made of single commands.
bool is_of_single_commands(const temporal::FlexiblePlan& plan);

struct SingleCommand {
  temporal::FlexiblePlan plan;
  std::string activity;  ///< the command's in the plan
  std::string fault;     ///< in plain words; not empty: there is no plan
};

/// The plan in which an order of kind `command` is carried out: that command, and the single commands that run, which
/// go on. A component that carries one out takes no other.
SingleCommand plan_of_command(const orders::Order& order, const mission::MissionModel& mission,
                              std::uint32_t version, temporal::Time now,
                              const executive::Executive& executive);

}  // namespace roci::exec::reactor
