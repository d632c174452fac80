/// The reactor and executive as a process: goals, observations, acknowledgements and planner replies in;
/// commands, plans, statuses and events out; everything journalled before it is sent.
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

/// Alone, with the journal of the run folder.
std::unique_ptr<services::Service> make_service(services::Node&, const services::RunSettings&);

/// Alone, with this journal, in this epoch.
std::unique_ptr<services::Service> make_executive(services::Node&, const services::RunSettings&,
                                                  journal::Journal&, std::uint64_t epoch);

/// The leader of a pair; `doubtful` as in JournaledReactor. It takes in the goals that are kept `apart` first.
std::unique_ptr<services::Service> make_executive(services::Node&, const services::RunSettings&,
                                                  journal::Journal&, standby::LeaderService&, bool doubtful,
                                                  const standby::GoalsApart& apart);

}  // namespace roci::exec
