#include "services/process/service_main.hpp"
#include "tests/missions/beacon/beacon_service.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "beacon_driver", roci::beacon::make_service);
}
