// The heartbeat of a service. The work loop itself calls beat(), so that a hung loop goes silent.
#pragma once

#include "services/clock/wall.hpp"
#include "services/publisher.hpp"

namespace roci::services {

class Heart {
 public:
  explicit Heart(Node&);

  void beat(wall::Instant now);  // each turn of the loop; sends when it is time
  void leave();                  // the last one, SERVICE_STOPPING
  wall::Instant next() const { return next_; }

 private:
  void send(v1::ServiceState);

  Publisher<v1::Heartbeat> publisher_;
  v1::Heartbeat beat_;
  std::uint64_t turns_ = 0;
  wall::Instant next_;
};

}  // namespace roci::services
