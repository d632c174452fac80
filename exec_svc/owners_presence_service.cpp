#include "exec_svc/owners_presence_service.hpp"

#include <utility>

#include "exec_svc/journal/journal.hpp"

namespace roci::exec {

using services::health::PeerChange;

namespace {

// Returns the time for known services to be heard of after a restart; live, it is wall time.
temporal::Duration reunion(const services::Node& node) {
  const bool live = node.options().clock == services::clock::ClockMode::live;
  return temporal::seconds(5 * (live ? node.options().live_scale : 1));
}

}  // namespace

OwnersPresence::OwnersPresence(services::Node& node, journal::Journal& journal, std::set<std::string> owners,
                               temporal::Duration owner_return, Listeners listeners)
    : node_(node),
      journal_(journal),
      owners_(std::move(owners)),
      owner_return_(owner_return),
      listeners_(std::move(listeners)) {}

void OwnersPresence::take(const PeerChange& change) {
  if (!change.alive && owner_return_ > temporal::Duration(0) && owners_.contains(change.service))
    return wait_for(change);
  if (const auto dead = awaited_.extract(change.service)) node_.cancel(dead.mapped());
  lose_or_find(change);
}

void OwnersPresence::recall_peers() {
  missed_ = journal_.peers();
  node_.after(reunion(node_), [this] { give_up_missed(); });
}

// Waits for the owner, which may go on where it stood: its commands are not lost before it has had time to
// come back.
void OwnersPresence::wait_for(const PeerChange& change) {
  awaited_[change.service] = node_.after(owner_return_, [this, change] {
    awaited_.erase(change.service);
    lose_or_find(change);
  });
}

void OwnersPresence::lose_or_find(const PeerChange& change) {
  const auto known = missed_.extract(change.service);
  listeners_.changed(change);
  if (!change.alive) {
    journal_.remove_peer(change.service);
    listeners_.lost(change.service, change.cause);
  } else if (known.empty() || known.mapped() != change.incarnation) {
    journal_.put_peer(change.service, change.incarnation);
    if (!known.empty()) listeners_.lost(change.service, "restarted while the executive was away");
    listeners_.arrived(change.service);
  }
  listeners_.looked();
}

void OwnersPresence::give_up_missed() {
  for (const auto& [service, incarnation] : std::exchange(missed_, {})) {
    journal_.remove_peer(service);
    listeners_.lost(service, "gone since the executive was away");
  }
  listeners_.looked();
}

}  // namespace roci::exec
