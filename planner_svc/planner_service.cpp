#include "planner_svc/planner_service.hpp"

#include "planner_svc/engine_host_service.hpp"
#include "planner_svc/engines.hpp"

namespace roci::planner {

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  return host_engines(node, settings, engines());
}

}  // namespace roci::planner
