#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "core/bytes/crc_32.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/binary_fields.hpp"

namespace roci::planner::utility_htn::reading {

namespace {

void append_varint(std::string& out, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7U) out += static_cast<char>(value | 0x80U);
  out += static_cast<char>(value);
}

std::uint64_t zigzag(std::int64_t value) {
  return static_cast<std::uint64_t>(value) << 1U ^ static_cast<std::uint64_t>(value >> 63);
}

class ByteWriter {
 public:
  template <typename T>
  using Of = const T&;

  void number(std::uint64_t value) { append_varint(out_, value); }
  void whole(std::int32_t value) { number(zigzag(value)); }
  void flag(bool value) { number(value ? 1 : 0); }

  template <typename E>
  void enumeration(E value, std::uint64_t) {
    number(static_cast<std::uint64_t>(value));
  }

  // 0 and eight bytes, 1 and 2 for what is infinite, or a whole number from 3 on.
  void real(double value) {
    constexpr double kExact = 9007199254740992;  // 2^53
    if (std::isinf(value)) return number(value < 0 ? 1 : 2);
    if (std::abs(value) <= kExact && value == std::floor(value) && !(value == 0 && std::signbit(value)))
      return number(zigzag(static_cast<std::int64_t>(value)) + 3);
    number(0);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    bytes::append_little_endian(out_, bits, sizeof bits);
  }

  void time(temporal::Duration value) { number(value == temporal::no_bound ? 0 : zigzag(value.count()) + 1); }

  void text(const std::string& value) {
    const auto [known, added] = numbers_.emplace(value, texts_.size());
    if (added) texts_.push_back(&known->first);
    number(known->second);
  }

  void scores(const temporal::RankVector& utility) {
    number(utility.scores().size());
    for (const double score : utility.scores()) real(score);
  }

  template <typename T>
  void list(const std::vector<T>& items, std::size_t) {
    number(items.size());
    for (const T& item : items) one(item);
  }

  template <typename T>
  void optional(const std::optional<T>& value) {
    flag(value.has_value());
    if (value) one(*value);
  }

  std::string take() && {
    std::string body;
    append_varint(body, texts_.size());
    for (const std::string* text : texts_) {
      append_varint(body, text->size());
      body += *text;
    }
    return body + out_;
  }

 private:
  void one(std::uint32_t value) { number(value); }
  void one(const std::string& value) { text(value); }
  template <typename T>
  void one(const T& value) {
    fields(*this, value);
  }

  std::string out_;
  std::map<std::string, std::size_t> numbers_;
  std::vector<const std::string*> texts_;
};

}  // namespace

std::string to_binary(const model::Network& network) {
  ByteWriter writer;
  fields(writer, network);
  const std::string body = std::move(writer).take();
  std::string out(kBinaryMagic);
  out += static_cast<char>(kBinaryFormat);
  append_varint(out, body.size());
  out += body;
  bytes::append_little_endian(out, bytes::crc_32(out), kChecksumBytes);
  return out;
}

}  // namespace roci::planner::utility_htn::reading
