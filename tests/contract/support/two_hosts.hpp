// Two hosts: two network namespaces joined by a veth pair. Needs the right to make namespaces (root).
#pragma once

#include <unistd.h>

#include <string>
#include <vector>

namespace roci::services::contract {

/// Runs the command; throws std::runtime_error if it fails.
void run_on_host(const std::vector<std::string>& command);

struct Host {
  std::string name;
  std::string link;
  std::string address;

  /// The command, to be run on that host.
  std::vector<std::string> inside(const std::vector<std::string>& command) const;
};

/// Both hosts and their link, until the test ends. Without the right to make them there are none, and `refused` says
/// so: such a test is skipped (GTEST_SKIP) with that reason.
class TwoHosts {
 public:
  TwoHosts();
  ~TwoHosts();
  TwoHosts(const TwoHosts&) = delete;
  TwoHosts& operator=(const TwoHosts&) = delete;

  const std::string id = std::to_string(getpid());
  const Host rover{"roci-rover-" + id, "rr" + id, "10.77.0.1"};
  const Host ground{"roci-ground-" + id, "rg" + id, "10.77.0.2"};
  std::string refused;
};

}  // namespace roci::services::contract
