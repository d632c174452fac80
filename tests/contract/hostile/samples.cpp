#include "tests/contract/hostile/samples.hpp"

#include <algorithm>

namespace roci::services::contract::hostile {
namespace {

constexpr Entity kAnyReader = 0;
constexpr std::uint16_t kKeyHash = 0x0070, kStatusInfo = 0x0071;

Bytes with(Bytes payload, std::size_t at, std::uint32_t number) {
  for (std::size_t i = 0; i < 4 && at + i < payload.size(); ++i)
    payload[at + i] = static_cast<std::uint8_t>(number >> 8 * i);
  return payload;
}

Bytes status(std::uint8_t value) { return {0, 0, 0, value}; }

}  // namespace

HostileWriter::HostileWriter(const Participant& participant, Entity writer, Bytes good, Bytes of_another_type)
    : participant_(participant),
      writer_(writer),
      good_(std::move(good)),
      of_another_type_(std::move(of_another_type)) {}

void HostileWriter::keep(Message message) {
  message.heartbeat(kAnyReader, writer_, 1, number_, static_cast<std::uint32_t>(number_));
  participant_.send_to_readers(message);
  sent_.push_back(std::move(message));
}

void HostileWriter::data(std::uint8_t flags, const Bytes& inline_qos, const Bytes& payload) {
  ++number_;
  auto message = participant_.message();
  message.data(kAnyReader, writer_, number_,
               static_cast<std::uint8_t>(flags | (inline_qos.empty() ? 0 : kInlineQos)), inline_qos, payload);
  keep(std::move(message));
}

void HostileWriter::attack() {
  payloads();
  keys();
  ends();
  fragments();
}

void HostileWriter::repeat() const {
  for (const Message& message : sent_) participant_.send_to_readers(message);
}

void HostileWriter::payloads() {
  for (const std::size_t size : {std::size_t{4}, std::size_t{8}, good_.size() / 2, good_.size() - 4})
    data(kData, {}, {good_.begin(), good_.begin() + static_cast<long>(std::min(size, good_.size()))});
  for (const std::uint32_t length : {0x80000000u, 0x7fffffffu, 0xffffffffu})
    for (std::size_t at = 4; at < std::min<std::size_t>(good_.size(), 24); at += 4)
      data(kData, {}, with(good_, at, length));
  for (const std::uint8_t representation : {0x02, 0x03, 0x06, 0x09, 0x0b, 0x7f}) {
    Bytes other = good_;
    other[1] = representation;
    data(kData, {}, other);
  }
  for (const std::uint8_t fill : {0x7f, 0xff}) {  // unknown enumerators among them
    Bytes filled(good_.size(), fill);
    std::copy_n(good_.begin(), 4, filled.begin());
    data(kData, {}, filled);
  }
  data(kData, {}, of_another_type_);
}

void HostileWriter::keys() {
  const Bytes broken{0x00, 0x01, 0x00, 0x00, 0xff, 0xff, 0xff, 0x7f};
  data(kData, {}, broken);
  for (const std::uint8_t fill : {0x00, 0x5a})
    data(kData, Parameters().add(kKeyHash, Bytes(16, fill)).list(), broken);
  data(kKey, {}, broken);
  data(kKey, {}, good_);
  data(0, {}, {});
}

void HostileWriter::ends() {
  const Bytes broken{0x00, 0x01, 0x00, 0x00, 0xff, 0xff, 0xff, 0x7f};
  for (const std::uint8_t end : {1, 2, 3}) {
    const Bytes without_hash = Parameters().add(kStatusInfo, status(end)).list();
    data(0, without_hash, {});
    data(kKey, without_hash, broken);
    data(kKey, without_hash, good_);
    data(kData, without_hash, broken);
    data(0, Parameters().add(kKeyHash, Bytes(16, 0x5a)).add(kStatusInfo, status(end)).list(), {});
  }
}

void HostileWriter::fragments() {
  constexpr std::uint16_t kSize = 1024;
  const Bytes part(kSize, 0xff);
  ++number_;  // never completed
  keep(participant_.message().fragment(kAnyReader, writer_, number_, 1, 1, kSize, 16u << 20, part));
  ++number_;
  for (std::uint32_t first = 1; first <= 3; ++first)
    keep(participant_.message().fragment(kAnyReader, writer_, number_, first, 1, kSize, 3 * kSize, part));
}

}  // namespace roci::services::contract::hostile
