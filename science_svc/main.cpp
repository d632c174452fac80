#include "science_svc/science_service.hpp"
#include "services/service.hpp"

int main(int argc, char** argv) {
  return roci::services::service_main(argc, argv, "science_svc", roci::science::make_service);
}
