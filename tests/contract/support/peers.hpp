// The peer programs of peer/, by name.
#pragma once

#include <string>
#include <vector>

#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {

inline const std::string kPeerFolder = ROCI_SOURCE_DIR "/tests/contract/peer";

// Our own transports, or "native-fastdds" and "native-cyclonedds": the vendor's API and generated types.
inline std::vector<std::string> peer_command(const std::string& kind, const std::string& role, int domain) {
  const bool native = kind.starts_with("native-");
  const std::string program = ROCI_BINARY_DIR "/tests/contract-peer" + (native ? "-" + kind : "");
  return {program, role, kind, std::to_string(domain)};
}

inline std::vector<std::string> peer_environment(const std::string& kind) {
  if (!kind.starts_with("native-")) return {};
  return {"FASTRTPS_DEFAULT_PROFILES_FILE=" + kPeerFolder + "/fastdds_loopback.xml",
          "CYCLONEDDS_URI=" + kPeerFolder + "/cyclonedds_loopback.xml"};
}

class Peer : public ChildProcess {
 public:
  // `environment`: more variables of its own (peer/main.cpp).
  Peer(const std::string& kind, const std::string& role, int domain,
       const std::vector<std::string>& environment = {})
      : ChildProcess(peer_command(kind, role, domain), with(environment, peer_environment(kind))) {}

 private:
  static std::vector<std::string> with(std::vector<std::string> more, const std::vector<std::string>& own) {
    more.insert(more.end(), own.begin(), own.end());
    return more;
  }
};

}  // namespace roci::services::contract
