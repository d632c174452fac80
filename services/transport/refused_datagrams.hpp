// These are the datagrams that a network transport has refused before DDS read them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace roci::services::transport {

/// Counts the datagrams that were refused for one reason since the transport was opened.
struct RefusedDatagrams {
  /// Is one of a few words, e.g. "stranger" (vendors/guard/datagram_admission.hpp).
  std::string reason;
  std::uint64_t count = 0;
  /// Names the sender of the last one, as address and port; it is empty where that is unknown.
  std::string last_source;
};

/// Tells what was refused. A Transport behind a guard implements this, too.
class RefusesDatagrams {
 public:
  virtual ~RefusesDatagrams() = default;
  /// Returns every reason with a count above zero. Any thread may ask.
  virtual std::vector<RefusedDatagrams> refused_datagrams() const = 0;
};

}  // namespace roci::services::transport
