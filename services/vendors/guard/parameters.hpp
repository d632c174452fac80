// This file examines parameter lists of RTPS (2.3, 9.4.2.11): inline QoS, and the samples of discovery.
#pragma once

#include <array>
#include <functional>
#include <optional>

#include "services/vendors/guard/byte_view.hpp"
#include "services/vendors/guard/datagram_admission.hpp"

namespace roci::services::vendors::guard {

using GuidPrefix = std::array<std::uint8_t, 12>;

/// Returns whether `sender` may speak for the participant whose prefix begins `other` (of 12 bytes at least): itself
/// or, with Cyclone DDS, another one of its process. Prefixes of one process share their first four bytes, which in
/// ours name the socket.
bool may_speak_for(const GuidPrefix& sender, std::span<const std::uint8_t> other);

/// Says where a parameter list stands.
enum class ListKind { inline_qos, discovery };

/// Says what became of a parameter list, and how long it is.
struct ListAdmission {
  DatagramAdmission admission = DatagramAdmission::pass;
  std::size_t size = 0;  ///< Of the list with its sentinel, in bytes; 0 unless it passes.
};

/// Judges the list at the beginning of `list`: lengths, and the inner lengths of the parameters in which parsers have
/// had faults (names, partitions, properties, key hash, status, locators). With `only_guids_of`, each GUID and key hash
/// in it must be of one for which that participant may speak.
ListAdmission examine_parameters(const ByteView& list, ListKind,
                                 const std::optional<GuidPrefix>& only_guids_of);

/// Calls `see` with the value of each parameter with this id in a list that passed examine_parameters().
void for_each_parameter(const ByteView& list, std::uint16_t id, const std::function<void(const ByteView&)>& see);

/// Returns the value of the first parameter with this id in a list that passed examine_parameters(), or nothing.
std::optional<ByteView> find_parameter(const ByteView& list, std::uint16_t id);

}  // namespace roci::services::vendors::guard
