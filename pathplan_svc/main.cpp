#include "pathplan_svc/pathplan_service.hpp"

int main(int argc, char** argv) {
  return roci::services::service_main(argc, argv, "pathplan_svc", roci::pathplan::make_service);
}
