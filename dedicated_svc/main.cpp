#include "dedicated_svc/dedicated_service.hpp"
#include "services/process/service_main.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "dedicated_svc", roci::dedicated::make_service);
}
