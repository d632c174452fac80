// This is the reactor and executive as a process: goals, observations, acknowledgements and planner replies
// come in; commands, plans, statuses and events go out; everything is journaled before it is sent.
#pragma once

#include <cstdint>
#include <memory>

#include "services/service.hpp"

namespace roci::exec {

namespace journal {
class Journal;
}
namespace standby {
class GoalsApart;
class LeaderService;
}  // namespace standby

/// Makes an executive without a standby, with the journal of the run folder.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

/// Makes an executive without a standby that uses this journal and begins in this epoch.
std::unique_ptr<services::Service> make_executive(services::Node&, const services::RunSettings&,
                                                  journal::Journal&, std::uint64_t epoch);

/// Makes the leader of a pair; `doubtful` is as in JournaledReactor. It first takes in the goals that are kept
/// `apart`.
std::unique_ptr<services::Service> make_executive(services::Node&, const services::RunSettings&,
                                                  journal::Journal&, standby::LeaderService&, bool doubtful,
                                                  const standby::GoalsApart& apart);

}  // namespace roci::exec
