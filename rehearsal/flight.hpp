// A flight takes a mission with all services in this process, over the inproc transport, on the simulated
// clock.
#pragma once

#include <string>
#include <vector>

#include "core/mission/service_list.hpp"
#include "services/service.hpp"

namespace roci::rehearsal {

/// Has, in the run folder of each flight, a line of JSON for each event of any service, with its mission time,
/// its sender, code and text.
inline constexpr char kEventsFile[] = "events.jsonl";

/// A program by the name that it has as a process.
struct Program {
  std::string name;
  services::MakeService* make;
};

/// The programs that are linked here: those that a mission's list of services may name in a rehearsal.
const std::vector<Program>& programs();

/// The mission's services in the order in which a rehearsal makes them: the clock's master last.
std::vector<mission::ServiceEntry> crew_of(const std::filesystem::path& mission);

/// The node of one of them; `pace` as in FlightOptions.
services::node::NodeOptions node_options(const std::filesystem::path& mission, const mission::ServiceEntry&,
                                         double pace);

/// Finds that of a linked program, of one of `more`, which a mission names by a path, or of the file beside a program
/// of somebody else (loaded.hpp). Throws std::invalid_argument, with the remedy, where there is none.
services::MakeService* make_of(const mission::ServiceEntry&, const std::vector<Program>& more = {});

/// Says what is flown and how fast.
struct FlightOptions {
  services::RunSettings run;
  int domain = 1;   ///< flights with different domains do not hear each other
  double pace = 0;  ///< simulated seconds per wall second; 0: as fast as possible
  /// A user's own programs, by the names of their files.
  std::vector<Program> programs{};
};

/// Flies the services that the mission names. Returns when the clock's master has ended the run; the summary
/// of each executive stands in the run folder. Throws std::invalid_argument for a mission that names a program whose
/// service is neither linked here nor beside it, or no clock master,
/// and what a service threw while it was made or while it ran.
void fly(const FlightOptions& options);

}  // namespace roci::rehearsal
