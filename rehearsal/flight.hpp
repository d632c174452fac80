// One flight of a mission with all services in this process, over the inproc transport, on the simulated
// clock.
#pragma once

#include <string>
#include <vector>

#include "services/service.hpp"

namespace roci::rehearsal {

/// A service by the name that it has as a process.
struct Member {
  std::string name;
  services::MakeService* make;
};

/// Every service of a mission; the master of the clock (sim_svc) stands last.
const std::vector<Member>& members();

struct FlightOptions {
  services::RunSettings run;
  int domain = 1;   ///< flights with different domains do not hear each other
  double pace = 0;  ///< simulated seconds per wall second; 0: as fast as possible
};

/// Returns when the master has ended the run; the summary stands in run_folder/summary.json. Throws what a
/// service threw while it was made (bad mission files) or while it ran.
void fly(const FlightOptions& options);

}  // namespace roci::rehearsal
