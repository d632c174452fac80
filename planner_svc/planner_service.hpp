// This is the planner as a process, with the engines that it is shipped with.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::planner {

/// Makes host_engines() with the table of engines.cpp.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::planner
