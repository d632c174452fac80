// A planner's process with engines of one's own: the library of planner_svc on another table.
#include "planner_svc/engine_host_service.hpp"
#include "services/process/service_main.hpp"
#include "tests/engines/table.hpp"

namespace {

std::unique_ptr<roci::services::Service> make_service(roci::services::Node& node,
                                                      const roci::services::RunSettings& settings) {
  return roci::planner::host_engines(node, settings, roci::planner::proof::engines());
}

}  // namespace

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "proof_planner", make_service);
}
