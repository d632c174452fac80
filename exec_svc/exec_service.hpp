// The reactor and executive as a process: goals, observations, acknowledgements and planner replies in;
// commands, plans, statuses and events out; everything journalled before it is sent.
#pragma once

#include <memory>

#include "services/service.hpp"

namespace roci::exec {

std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

}  // namespace roci::exec
