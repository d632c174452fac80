#include "science_svc/science_service.hpp"
#include "services/process/service_main.hpp"

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "science_svc", roci::science::make_service);
}
