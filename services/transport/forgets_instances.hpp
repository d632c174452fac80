// What a writer can do beside writing, if its vendor can: give back the memory of what is finished.
#pragma once

#include <cstdint>
#include <span>

namespace roci::services::transport {

/// Is also a base of the writers of inproc and Cyclone DDS. Fast DDS 2.9 cannot: unregistering an instance of a
/// transient-local writer makes it turn for ever when the last reader confirms it (docs/dds.md),
/// and a disposed one is kept like others.
class ForgetsInstances {
 public:
  virtual ~ForgetsInstances() = default;
  /// Disposes the instance whose key members the (whole) payload holds, and keeps nothing of it once every reader has
  /// confirmed it.
  virtual bool forget(std::span<const std::uint8_t> payload) = 0;
};

}  // namespace roci::services::transport
