// These limits bound how far the vendors' own histories may grow (docs/resilience.md, "What is bounded").
#pragma once

#include <cstddef>

#include "services/vendors/instance_table.hpp"

namespace roci::services::vendors {

/// Bounds the keys of one type that Cyclone DDS keeps in a process, as our own table of a topic does: samples of new
/// keys are refused until the writers of others have gone. Fast DDS offers no such bound that leaves the topic alive
/// (key_slots.hpp).
inline constexpr std::size_t kKeysOfTopic = InstanceTable::kInstances;

/// Bounds the bytes of samples of a keep-all writer that not every reader has confirmed, beside its bound in number;
/// one sample may be larger. Cyclone DDS itself stops at half a megabyte (Internal/Watermarks/WhcHigh).
inline constexpr std::size_t kUnconfirmedBytes = std::size_t{64} << 20;

}  // namespace roci::services::vendors
