#include "tests/contract/hostile/rtps_message.hpp"

namespace roci::services::contract::hostile {

void put_u16(Bytes& out, std::uint16_t value) {
  out.push_back(static_cast<std::uint8_t>(value));
  out.push_back(static_cast<std::uint8_t>(value >> 8));
}
void put_u32(Bytes& out, std::uint32_t value) {
  put_u16(out, static_cast<std::uint16_t>(value));
  put_u16(out, static_cast<std::uint16_t>(value >> 16));
}
void put_entity(Bytes& out, Entity entity) {
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(entity >> shift));
}
void put_sequence_number(Bytes& out, std::int64_t number) {
  put_u32(out, static_cast<std::uint32_t>(static_cast<std::uint64_t>(number) >> 32));
  put_u32(out, static_cast<std::uint32_t>(number));
}
void put_bytes(Bytes& out, std::span<const std::uint8_t> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}

Parameters& Parameters::add(std::uint16_t id, Bytes value) {
  value.resize((value.size() + 3) / 4 * 4);
  put_u16(bytes_, id);
  put_u16(bytes_, static_cast<std::uint16_t>(value.size()));
  put_bytes(bytes_, value);
  return *this;
}

Parameters& Parameters::add_u32(std::uint16_t id, std::uint32_t number) {
  Bytes value;
  put_u32(value, number);
  return add(id, value);
}

namespace {

void put_string(Bytes& out, const std::string& text) {
  out.resize((out.size() + 3) / 4 * 4);
  put_u32(out, static_cast<std::uint32_t>(text.size() + 1));
  out.insert(out.end(), text.begin(), text.end());
  out.push_back(0);
}

// The set of a GAP, an ACKNACK or a NACK_FRAG behind its base.
void put_bits(Bytes& body, std::uint32_t bits, std::uint8_t each_byte) {
  put_u32(body, bits);
  body.resize(body.size() + (bits + 31) / 32 * 4, each_byte);
}

}  // namespace

Parameters& Parameters::add_string(std::uint16_t id, const std::string& text) {
  Bytes value;
  put_string(value, text);
  return add(id, value);
}

Parameters& Parameters::add_strings(std::uint16_t id, const std::vector<std::string>& texts) {
  Bytes value;
  put_u32(value, static_cast<std::uint32_t>(texts.size()));
  for (const std::string& text : texts) put_string(value, text);
  return add(id, value);
}

Parameters& Parameters::add_guid(std::uint16_t id, const Prefix& prefix, Entity entity) {
  Bytes value(prefix.begin(), prefix.end());
  put_entity(value, entity);
  return add(id, value);
}

Parameters& Parameters::add_locator(std::uint16_t id, std::uint32_t address, std::uint32_t port) {
  Bytes value;
  put_u32(value, 1);  // UDPv4
  put_u32(value, port);
  value.resize(20);
  put_entity(value, address);
  return add(id, value);
}

Bytes Parameters::list() const {
  Bytes list = bytes_;
  put_u16(list, 0x0001);
  put_u16(list, 0);
  return list;
}

Bytes Parameters::sample() const {
  Bytes sample{0x00, 0x03, 0x00, 0x00};
  put_bytes(sample, list());
  return sample;
}

Message::Message(const Prefix& sender, Vendor vendor)
    : bytes_{'R', 'T', 'P', 'S', 2, 2, vendor[0], vendor[1]} {
  put_bytes(bytes_, sender);
}

Message& Message::submessage(std::uint8_t id, std::uint8_t flags, const Bytes& body) {
  bytes_.push_back(id);
  bytes_.push_back(flags | 0x01);
  put_u16(bytes_, static_cast<std::uint16_t>((body.size() + 3) / 4 * 4));
  put_bytes(bytes_, body);
  bytes_.resize((bytes_.size() + 3) / 4 * 4);
  return *this;
}

Message& Message::data(Entity reader, Entity writer, std::int64_t number, std::uint8_t flags,
                       const Bytes& inline_qos, const Bytes& payload) {
  Bytes body;
  put_u16(body, 0);
  put_u16(body, 16);
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, number);
  put_bytes(body, inline_qos);
  put_bytes(body, payload);
  return submessage(0x15, flags, body);
}

Message& Message::fragment(Entity reader, Entity writer, std::int64_t number, std::uint32_t first,
                           std::uint16_t count, std::uint16_t size, std::uint32_t sample_size,
                           const Bytes& part) {
  Bytes body;
  put_u16(body, 0);
  put_u16(body, 28);
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, number);
  put_u32(body, first);
  put_u16(body, count);
  put_u16(body, size);
  put_u32(body, sample_size);
  put_bytes(body, part);
  return submessage(0x16, 0, body);
}

Message& Message::heartbeat(Entity reader, Entity writer, std::int64_t first, std::int64_t last,
                            std::uint32_t count) {
  Bytes body;
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, first);
  put_sequence_number(body, last);
  put_u32(body, count);
  return submessage(0x07, 0, body);
}

Message& Message::gap(Entity reader, Entity writer, std::int64_t start, std::int64_t base,
                      std::uint32_t bits) {
  Bytes body;
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, start);
  put_sequence_number(body, base);
  put_bits(body, bits, 0);
  return submessage(0x08, 0, body);
}

Message& Message::acknack(Entity reader, Entity writer, std::int64_t base, std::uint32_t bits,
                          std::uint8_t asked, std::uint32_t count) {
  Bytes body;
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, base);
  put_bits(body, bits, asked);
  put_u32(body, count);
  return submessage(0x06, 0, body);
}

Message& Message::nack_fragments(Entity reader, Entity writer, std::int64_t number, std::uint32_t base,
                                 std::uint32_t bits, std::uint8_t asked, std::uint32_t count) {
  Bytes body;
  put_entity(body, reader);
  put_entity(body, writer);
  put_sequence_number(body, number);
  put_u32(body, base);
  put_bits(body, bits, asked);
  put_u32(body, count);
  return submessage(0x12, 0, body);
}

}  // namespace roci::services::contract::hostile
