#include "arm_svc/arm_service.hpp"
#include "services/process/service_main.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "arm_svc", roci::arm::make_service);
}
