// The planner as a process: hosts the engines that it is shipped with.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::planner {

/// host_engines() with the table of engines.cpp.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::planner
