// Throws datagrams at the participants of a domain on loopback: mutants of their own traffic, and forged messages.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "tests/contract/hostile/participant.hpp"

namespace roci::services::contract::hostile {

struct Datagram {
  int from = 0;  ///< The port it came from.
  int port = 0;  ///< The port it went to.
  Bytes bytes;
};

/// Hears what goes over the loopback to the ports of a domain.
/// Throws std::system_error without the right to (CAP_NET_RAW).
class Listener {
 public:
  explicit Listener(int domain);
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  /// Adds what has come since; waits for at most `wait_ms` for the first.
  void hear(std::vector<Datagram>& into, int wait_ms);

 private:
  const int first_port_;
  int socket_ = -1;
};

class Injector {
 public:
  Injector(int domain, std::uint64_t seed);

  /// Hears 50 datagrams, then sends `count` and goes on, as fast as it hears others; asks `go_on(count was reached)`
  /// all the while.
  void send(std::uint64_t count, const std::function<bool(bool enough)>& go_on);

 private:
  void hear();
  Datagram next();
  Bytes mutated(const Bytes&);
  Bytes under_own_name(const Bytes&);
  Bytes forged(const Bytes& heard);
  std::size_t number(std::size_t below) {
    return std::uniform_int_distribution<std::size_t>(0, below - 1)(random_);
  }

  std::mt19937_64 random_;
  Listener listener_;
  Participant own_;
  std::array<Socket, 4> sockets_;
  std::vector<Datagram> heard_;
};

}  // namespace roci::services::contract::hostile
