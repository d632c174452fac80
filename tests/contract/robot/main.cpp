// contract-robot OPTIONS: a service process (see --help) that says on standard output what it hears. The environment
// may name what its participant announces (ROBOT_ANNOUNCEMENT).
#include <cstdlib>
#include <iostream>

#include "services/process/service_main.hpp"
#include "tests/contract/robot/robot_service.hpp"

namespace roci::services::contract {
namespace {

std::unique_ptr<Service> make_service(Node& node, const RunSettings&) {
  return make_robot_service(node, [](const std::string& line) { std::cout << line << std::endl; });
}

void run(const process::ServiceOptions& given, process::StopSignals& signals) {
  process::ServiceOptions options = given;
  if (const char* announcement = std::getenv("ROBOT_ANNOUNCEMENT"))
    options.connection.transport.announcement = announcement;
  process::run_service(options, signals, make_service);
}

}  // namespace
}  // namespace roci::services::contract

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "contract-robot", roci::services::contract::run);
}
