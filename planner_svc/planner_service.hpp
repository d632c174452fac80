// The planner as a process: answers PlanRequest with a plan or a verdict; asks the owners of external
// functions for values.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::planner {

std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::planner
