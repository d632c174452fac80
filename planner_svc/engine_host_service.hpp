// A planner's process on DDS, whatever its engines: a program of one's own stands on a table of one's own.
#pragma once

#include <memory>

#include "planner_svc/engine/table.hpp"
#include "services/service.hpp"

namespace roci::planner {

/// Answers PlanRequest by the engine of the table that it names, and asks the owners of external functions
/// for values. Where the mission's engine plans all the time, steps it and sends the versions of its plan.
/// `table` outlives the service.
std::unique_ptr<services::Service> host_engines(services::Node& node, const services::RunSettings& settings,
                                                const engine::Table& table);

}  // namespace roci::planner
