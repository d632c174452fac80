#include "exec_svc/exec_service.hpp"
#include "services/service.hpp"

int main(int argc, char** argv) {
  return roci::services::service_main(argc, argv, "exec_svc", roci::exec::make_service);
}
