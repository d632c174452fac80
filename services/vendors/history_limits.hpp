// How far the vendors' own histories may grow (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors {

/// Keys of one type that Cyclone DDS keeps in a process, as many as our own table of a topic follows: samples of new
/// ones are refused there, until the writers of others have gone.
/// Fast DDS offers no such bound that leaves the topic alive (qos.cpp).
inline constexpr std::size_t kKeysOfTopic = InstanceTable::kInstances;

/// Bytes of samples of a keep-all writer that not every reader has confirmed, beside its bound in number; one sample
/// may be larger. Cyclone DDS itself stops at half a megabyte (Internal/Watermarks/WhcHigh).
inline constexpr std::size_t kUnconfirmedBytes = std::size_t{64} << 20;

}  // namespace roci::services::vendors
