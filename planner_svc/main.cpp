#include "planner_svc/planner_service.hpp"
#include "services/process/service_main.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "planner_svc", roci::planner::make_service);
}
