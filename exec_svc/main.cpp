#include <stdexcept>

#include "exec_svc/exec_service.hpp"
#include "exec_svc/journal/journal.hpp"
#include "exec_svc/pair_service.hpp"
#include "services/process/service_main.hpp"

namespace {

void run(const roci::services::process::ServiceOptions& options,
         roci::services::process::StopSignals& signals) {
  if (options.run.pair.empty()) {
    roci::services::process::run_service(options, signals, roci::exec::make_service);
  } else {
    roci::exec::run_pair(options, signals);
  }
}

// Runs the process. A journal that a newer version wrote counts as bad input, since a restart does not help.
void run_or_refuse(const roci::services::process::ServiceOptions& options,
                   roci::services::process::StopSignals& signals) {
  try {
    run(options, signals);
  } catch (const roci::exec::journal::NewerJournal& error) {
    throw std::invalid_argument(error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return roci::services::process::service_main(argc, argv, "exec_svc", run_or_refuse);
}
