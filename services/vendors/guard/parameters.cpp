#include "services/vendors/guard/parameters.hpp"

#include <algorithm>
#include <initializer_list>

#include "services/vendors/guard/rtps_ids.hpp"

namespace roci::services::vendors::guard {
namespace {

bool one_of(std::uint16_t id, std::initializer_list<std::uint16_t> ids) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool names_guid(std::uint16_t id) {
  return one_of(id, {kParticipantGuid, kEndpointGuid, kGroupGuid, kKeyHash});
}
bool is_string(std::uint16_t id) { return one_of(id, {kTopicName, kTypeName, kEntityName}); }
bool is_octets(std::uint16_t id) { return one_of(id, {kUserData, kGroupData, kTopicData}); }
bool is_locator(std::uint16_t id) {
  return one_of(id, {kUnicastLocator, kMulticastLocator, kDefaultUnicastLocator, kMetatrafficUnicastLocator,
                     kMetatrafficMulticastLocator, kDefaultMulticastLocator});
}

// Moves `at` behind a counted run of bytes; false if it does not fit.
bool skip_counted(const ByteView& value, std::size_t& at) {
  at = (at + 3) / 4 * 4;
  if (at > value.size() || value.size() - at < 4) return false;
  const std::uint32_t length = value.u32(at);
  at += 4;
  if (length > value.size() - at) return false;
  at += length;
  return true;
}

// A sequence of strings, or of structs of `strings_each` strings.
bool holds_strings(const ByteView& value, std::size_t strings_each) {
  if (value.size() < 4) return false;
  const std::uint32_t count = value.u32(0);
  std::size_t at = 4;
  if (count > value.size() / 4) return false;
  for (std::uint32_t i = 0; i < count * strings_each; ++i)
    if (!skip_counted(value, at)) return false;
  return true;
}

bool fits(std::uint16_t id, const ByteView& value, ListKind kind) {
  if (id == kKeyHash) return value.size() == 16;
  if (id == kStatusInfo) return value.size() == 4;
  if (kind == ListKind::inline_qos) return true;
  std::size_t at = 0;
  if (names_guid(id)) return value.size() == 16;
  if (id == kLease) return value.size() == 8;
  if (is_locator(id)) return value.size() == 24;
  if (is_string(id) || is_octets(id)) return skip_counted(value, at);
  if (id == kPartition) return holds_strings(value, 1);
  if (id == kPropertyList) return holds_strings(value, 2);
  return true;
}

}  // namespace

bool may_speak_for(const GuidPrefix& sender, std::span<const std::uint8_t> other) {
  if (std::equal(sender.begin(), sender.end(), other.begin())) return true;
  if (sender[0] >= 0x80) return std::equal(sender.begin(), sender.begin() + 8, other.begin());
  const bool ours = sender[0] == 'R' && sender[1] == 'o';
  const bool eclipse = sender[0] == 0x01 && sender[1] == 0x10;
  return (ours || eclipse) && std::equal(sender.begin(), sender.begin() + 4, other.begin());
}

ListAdmission examine_parameters(const ByteView& list, ListKind kind,
                                 const std::optional<GuidPrefix>& only_guids_of) {
  std::size_t at = 0;
  for (;;) {
    if (list.size() - at < 4) return {DatagramAdmission::bad_parameters};
    const auto id = static_cast<std::uint16_t>(list.u16(at) & ~kMustUnderstand);
    const std::size_t length = list.u16(at + 2);
    at += 4;
    if (id == kSentinel) return {DatagramAdmission::pass, at};
    if (length % 4 != 0 || length > list.size() - at) return {DatagramAdmission::bad_parameters};
    const ByteView value = list.part(at, length);
    at += length;
    if (id == kPadding) continue;
    if (!fits(id, value, kind)) return {DatagramAdmission::bad_parameters};
    if (only_guids_of && names_guid(id) && value.size() >= only_guids_of->size() &&
        !may_speak_for(*only_guids_of, value.bytes)) {
      return {DatagramAdmission::speaks_for_another};
    }
  }
}

void for_each_parameter(const ByteView& list, std::uint16_t wanted,
                        const std::function<void(const ByteView&)>& see) {
  for (std::size_t at = 0;;) {
    const auto id = static_cast<std::uint16_t>(list.u16(at) & ~kMustUnderstand);
    const std::size_t length = list.u16(at + 2);
    if (id == kSentinel) return;
    if (id == wanted) see(list.part(at + 4, length));
    at += 4 + length;
  }
}

std::optional<ByteView> find_parameter(const ByteView& list, std::uint16_t wanted) {
  std::optional<ByteView> first;
  for_each_parameter(list, wanted, [&first](const ByteView& value) {
    if (!first) first = value;
  });
  return first;
}

}  // namespace roci::services::vendors::guard
