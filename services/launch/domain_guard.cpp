#include "services/launch/domain_guard.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>

#include "services/clock/wall.hpp"
#include "services/process/domain_claim.hpp"

namespace roci::services::launch {
namespace {

// Participants find each other within a second; the newest heartbeat of each comes with that.
constexpr clock::WallDuration kListen = std::chrono::seconds(3);
constexpr std::chrono::milliseconds kListenTurn{20};

// Every launcher gives its run a name. What does not print is a damaged sample's, and no run's.
bool may_be_a_run(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '!' && c <= '~'; });
}

void refuse_foreign(const Node& node, int domain) {
  for (const auto& [run, samples] : node.foreign_runs()) {
    if (!may_be_a_run(run)) continue;
    throw std::invalid_argument("domain " + std::to_string(domain) + " is held by another run, \"" + run +
                                "\"; choose another one, or leave --domain out for a free one");
  }
}

// Members of a pair share a name, so one that is heard does not stand in for the other.
void refuse_twins(const std::set<std::string>& alive, const Options& options) {
  for (const std::string& service : options.services) {
    const mission::ServiceEntry* entry = entry_of(options, service);
    const bool shared = entry != nullptr && entry->paired && options.standby;
    if (shared || !alive.contains(service)) continue;
    throw std::invalid_argument("run \"" + options.run + "\" has a " + service +
                                " already; end it, or start other services of the run here with --services");
  }
}

}  // namespace

bool domain_may_be_held(const Options& options) {
  const auto& transport = options.connection.transport;
  if (!options.domain_given) return false;
  return !transport.peers.empty() || !transport.address.starts_with("127.") ||
         process::has_participants(transport.domain);
}

void refuse_held_domain(Node& node, const Options& options) {
  const auto alive = std::make_shared<std::set<std::string>>();
  node.on_peer_change([alive](const health::PeerChange& change) {
    if (change.alive) {
      alive->insert(change.service);
    } else {
      alive->erase(change.service);
    }
  });
  const clock::WallTime end = clock::wall_now() + kListen;
  while (clock::wall_now() < end) {
    node.spin_once(kListenTurn);
    if (!options.shared_domain && !options.continued)
      refuse_foreign(node, options.connection.transport.domain);
    refuse_twins(*alive, options);
  }
}

}  // namespace roci::services::launch
