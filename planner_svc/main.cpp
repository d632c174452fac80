#include "planner_svc/planner_service.hpp"
#include "services/service.hpp"

int main(int argc, char** argv) {
  return roci::services::service_main(argc, argv, "planner_svc", roci::planner::make_service);
}
