#include "services/process/service_main.hpp"
#include "sim_svc/sim_service.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "sim_svc", roci::sim::make_service);
}
