#include "pathplan_svc/pathplan_service.hpp"
#include "services/process/service_main.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "pathplan_svc", roci::pathplan::make_service);
}
