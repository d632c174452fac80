// A port is one end of a ping-pong over DDS: it sends a path request or its reply (about 108 bytes of CDR)
// and hands over what it receives. There are ports on our transports and, for comparison, directly on each
// vendor's API with its generated types.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace roci::bench {

/// Is what goes to and fro.
struct Ball {
  std::int64_t sequence = 0;
  double x_m = 0;
  double y_m = 0;
};

enum class Side { client, server };

/// Says which end of the ping-pong a port is.
struct PortOptions {
  Side side = Side::client;
  int domain = 0;
  std::function<void(const Ball&)> on_ball;  // called from a vendor thread
  bool secure = false;                       // of ours alone: with the certificates of kKeysVariable
};

/// Names the key folder of secure kinds in the environment of both processes.
inline constexpr char kKeysVariable[] = "ROCI_SECURE";

/// Is the interface of one end.
class Port {
 public:
  virtual ~Port() = default;
  virtual bool send(const Ball&) = 0;
  virtual bool matched() const = 0;  // both topics of the pair
};

/// These open ports on a vendor's own API, and on our transport over a vendor.
std::unique_ptr<Port> open_fastdds(PortOptions);
std::unique_ptr<Port> open_cyclonedds(PortOptions);
std::unique_ptr<Port> open_ours(const std::string& vendor, PortOptions);

// Sends a function request with 1,000 tuples of two objects there, and 1,000 numbers and outcomes back.
std::unique_ptr<Port> open_ours_with_tuples(const std::string& vendor, PortOptions);

// Makes a call over services/rpc.hpp between two nodes: loops, health and repetition are included.
std::unique_ptr<Port> open_calls(const std::string& vendor, PortOptions);

// Sends an observation to exec_svc there, and the command that waited for it back: event loop, reactor and
// the journal's write to disk are included.
std::unique_ptr<Port> open_reaction(const std::string& vendor, PortOptions);

/// Is the kind of which a server is the dedicated executive of open_dedicated_reaction() alone.
inline constexpr char kDedicatedKind[] = "imager";

// The same with a dedicated executive, in a process of its own, between exec_svc and the robot: what completes goes
// up through it and the next command down. The second function opens that process's end.
std::unique_ptr<Port> open_dedicated_reaction(const std::string& vendor, PortOptions);
std::unique_ptr<Port> open_dedicated(const std::string& vendor, const PortOptions&);

}  // namespace roci::bench
