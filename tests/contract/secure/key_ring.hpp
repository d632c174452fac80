// A key folder for a test, with the certificates of a mission (the planetary one where none is named), made by the
// library behind roci-keys.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/security/authority.hpp"

namespace roci::services::contract {

class KeyRing {
 public:
  /// A folder of this process's own, which goes with this object.
  explicit KeyRing(const std::string& mission = ROCI_SOURCE_DIR "/missions/planetary");
  ~KeyRing();
  KeyRing(const KeyRing&) = delete;
  KeyRing& operator=(const KeyRing&) = delete;

  std::string path() const { return folder_ / "keys"; }
  security::Authority authority() const { return security::Authority::open(folder_ / "keys"); }
  /// Another folder with the same files, as somebody has them who took them earlier.
  std::string stolen_copy(const std::string& name) const;

  static std::int64_t now_s();

 private:
  std::filesystem::path folder_;
};

/// "NAME=value" lines for a peer (tests/contract/peer) with the certificate of a service.
std::vector<std::string> peer_keys(const std::string& keys, const std::string& service);

}  // namespace roci::services::contract
