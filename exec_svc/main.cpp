#include "exec_svc/exec_service.hpp"
#include "exec_svc/standby/pair_service.hpp"
#include "services/process/service_main.hpp"

namespace {

void run(const roci::services::process::ServiceOptions& options,
         roci::services::process::StopSignals& signals) {
  if (options.run.pair.empty()) {
    roci::services::process::run_service(options, signals, roci::exec::make_service);
  } else {
    roci::exec::standby::run_pair(options, signals);
  }
}

}  // namespace

int main(int argc, char** argv) { return roci::services::process::service_main(argc, argv, "exec_svc", run); }
