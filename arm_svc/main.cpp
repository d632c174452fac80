#include "arm_svc/arm_service.hpp"

int main(int argc, char** argv) {
  return roci::services::service_main(argc, argv, "arm_svc", roci::arm::make_service);
}
