// A writer may be able, if its vendor is, to give back the memory of finished instances.
#pragma once

#include <cstdint>
#include <span>

namespace roci::services::transport {

/// Forgets finished instances; it is a second base of the writers of all three transports.
class ForgetsInstances {
 public:
  virtual ~ForgetsInstances() = default;
  /// Disposes the instance whose key members the (whole) payload holds, and keeps nothing of it once every reader has
  /// confirmed it. Fast DDS may do so in a later call that writes or forgets, when every reader has confirmed all that
  /// was written (docs/dds.md, 16), and keeps one instance of a writer.
  virtual bool forget(std::span<const std::uint8_t> payload) = 0;
};

}  // namespace roci::services::transport
