#include "exec_svc/exec_service.hpp"
#include "exec_svc/standby/pair_service.hpp"
#include "services/service_options.hpp"

namespace {

void run(const roci::services::ServiceOptions& options, roci::services::StopSignals& signals) {
  if (options.run.pair.empty()) {
    roci::services::run_service(options, signals, roci::exec::make_service);
  } else {
    roci::exec::standby::run_pair(options, signals);
  }
}

}  // namespace

int main(int argc, char** argv) { return roci::services::service_main(argc, argv, "exec_svc", run); }
