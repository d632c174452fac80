// Parameter lists of RTPS (2.3, 9.4.2.11): inline QoS, and the samples of discovery.
#pragma once

#include <array>
#include <optional>

#include "services/vendors/guard/byte_view.hpp"
#include "services/vendors/guard/verdict.hpp"

namespace roci::services::vendors::guard {

using GuidPrefix = std::array<std::uint8_t, 12>;

enum class ListKind { inline_qos, discovery };

struct ListVerdict {
  Verdict verdict = Verdict::pass;
  std::size_t size = 0;  ///< Of the list with its sentinel, in bytes; 0 unless it passes.
};

/// Judges the list at the beginning of `list`: lengths, and the inner lengths of the parameters in which parsers have
/// had faults (names, partitions, properties, key hash, status, locators). With `only_guids_of`, each GUID and key hash in
/// it must be of that participant.
ListVerdict examine_parameters(const ByteView& list, ListKind,
                               const std::optional<GuidPrefix>& only_guids_of);

}  // namespace roci::services::vendors::guard
