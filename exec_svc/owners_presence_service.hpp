// Owners' presence says who of the other services is there: what the reactor hears of losses and arrivals,
// over the executive's own restarts and over short deaths of owners that the mission waits for (`executive:
// owner_return_s`).
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "core/temporal/duration.hpp"
#include "services/node.hpp"

namespace roci::exec {

namespace journal {
class Journal;
}

/// Turns changes of peers into losses and arrivals, each reported once.
class OwnersPresence {
 public:
  struct Listeners {
    std::function<void(const services::health::PeerChange&)> changed;  ///< first of all, where it counts
    std::function<void(const std::string& service, const std::string& cause)> lost;
    std::function<void(const std::string& service)> arrived;
    std::function<void()> looked;  ///< after all of that
  };

  /// Reports the death of one of `owners` once it has stayed away for `owner_return` (0: at once). `journal`
  /// keeps who is there.
  OwnersPresence(services::Node& node, journal::Journal& journal, std::set<std::string> owners,
                 temporal::Duration owner_return, Listeners listeners);

  void take(const services::health::PeerChange& change);

  /// Goes on after a restart of the executive: a service that was there before is lost if it is not heard within the
  /// reunion time; one that comes in another incarnation was lost meanwhile, too.
  void recall_peers();

 private:
  void wait_for(const services::health::PeerChange& change);
  void lose_or_find(const services::health::PeerChange& change);
  void give_up_missed();

  services::Node& node_;
  journal::Journal& journal_;
  std::set<std::string> owners_;
  temporal::Duration owner_return_;
  Listeners listeners_;
  std::map<std::string, std::uint32_t> missed_;  // services of before the restart, not heard of since
  std::map<std::string, services::Node::TimerId> awaited_;  // owners that died and may come back in time
};

}  // namespace roci::exec
