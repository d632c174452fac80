// What a network transport has refused before DDS read it, for whoever tells operators.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roci::services::transport {

/// Counts those of one reason, since the transport was opened.
struct RefusedDatagrams {
  /// Is one of a few words, e.g. "stranger" (vendors/guard/datagram_admission.hpp).
  std::string reason;
  std::uint64_t count = 0;
  /// Names the sender of the last one, as address and port; it is empty where nobody knows.
  std::string last_source;
};

/// A Transport that a guard stands before is one of these, too.
class RefusesDatagrams {
 public:
  virtual ~RefusesDatagrams() = default;
  /// Every reason with a count above zero. Any thread may ask.
  virtual std::vector<RefusedDatagrams> refused_datagrams() const = 0;
};

}  // namespace roci::services::transport
