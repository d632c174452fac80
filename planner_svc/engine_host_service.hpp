// This is a planner's process on DDS, whatever its engines: a program of one's own brings a table of its own.
#pragma once

#include <memory>

#include "planner_svc/engine/table.hpp"
#include "services/service.hpp"

namespace roci::planner {

/// Makes a service that answers PlanRequest by the engine of the table that it names, and asks the owners of
/// external functions for values. Where the mission's engine plans all the time, the service steps it and
/// sends the versions of its plan. `table` must outlive the service.
std::unique_ptr<services::Service> host_engines(services::Node& node, const services::RunSettings& settings,
                                                const engine::Table& table);

}  // namespace roci::planner
