// The domain guard listens before a run starts: whoever holds the domain says so by its heartbeats.
#pragma once

#include "services/launch/options.hpp"
#include "services/node.hpp"

namespace roci::services::launch {

/// Returns whether somebody may be on the run's domain already: a domain that was given is not claimed, so other
/// participants of this host or of another one may use it. To be asked before this process opens its transport.
bool domain_may_be_held(const Options&);

/// Listens for kListen at most with a node that observes the run. Throws std::invalid_argument if another run is heard
/// on the domain (unless options say that it may be shared, or the run is continued: neither obeys the other, and who
/// writes to the domain must not keep a robot's launcher from coming back), or one of the services to be started, of
/// this very run.
void refuse_held_domain(Node&, const Options&);

}  // namespace roci::services::launch
