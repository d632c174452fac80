// Builds RTPS messages byte by byte (RTPS 2.3, chapter 9), well-formed ones and others. Little-endian.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace roci::services::contract::hostile {

using Bytes = std::vector<std::uint8_t>;
using Prefix = std::array<std::uint8_t, 12>;
using Vendor = std::array<std::uint8_t, 2>;

inline constexpr Vendor kEprosima{0x01, 0x0f};
inline constexpr Vendor kEclipse{0x01, 0x10};

/// An entity id as a number, its first octet on top: 0x000100c2 is the writer of participants.
using Entity = std::uint32_t;

void put_u16(Bytes&, std::uint16_t);
void put_u32(Bytes&, std::uint32_t);
void put_entity(Bytes&, Entity);
void put_sequence_number(Bytes&, std::int64_t);
void put_bytes(Bytes&, std::span<const std::uint8_t>);

/// A list of parameters, as inline QoS and as a sample of discovery.
class Parameters {
 public:
  Parameters& add(std::uint16_t id, Bytes value);
  Parameters& add_u32(std::uint16_t id, std::uint32_t value);
  Parameters& add_string(std::uint16_t id, const std::string&);
  Parameters& add_strings(std::uint16_t id, const std::vector<std::string>&);
  Parameters& add_guid(std::uint16_t id, const Prefix&, Entity);
  Parameters& add_locator(std::uint16_t id, std::uint32_t address, std::uint32_t port);

  /// With its sentinel.
  Bytes list() const;
  /// Behind the encapsulation header of a sample of discovery.
  Bytes sample() const;

 private:
  Bytes bytes_;
};

enum DataFlags : std::uint8_t { kInlineQos = 0x02, kData = 0x04, kKey = 0x08 };

class Message {
 public:
  Message(const Prefix& sender, Vendor vendor);

  Message& submessage(std::uint8_t id, std::uint8_t flags, const Bytes& body);
  Message& data(Entity reader, Entity writer, std::int64_t number, std::uint8_t flags,
                const Bytes& inline_qos, const Bytes& payload);
  /// Fragments `first` to `first + count - 1`, whose bytes are `part`.
  Message& fragment(Entity reader, Entity writer, std::int64_t number, std::uint32_t first,
                    std::uint16_t count, std::uint16_t size, std::uint32_t sample_size, const Bytes& part);
  Message& heartbeat(Entity reader, Entity writer, std::int64_t first, std::int64_t last,
                     std::uint32_t count);
  Message& gap(Entity reader, Entity writer, std::int64_t start, std::int64_t base, std::uint32_t bits);
  /// `asked`: each byte of the set of numbers.
  Message& acknack(Entity reader, Entity writer, std::int64_t base, std::uint32_t bits, std::uint8_t asked = 0,
                   std::uint32_t count = 1);
  Message& nack_fragments(Entity reader, Entity writer, std::int64_t number, std::uint32_t base,
                          std::uint32_t bits, std::uint8_t asked, std::uint32_t count);

  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace roci::services::contract::hostile
