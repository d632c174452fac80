#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "core/bytes/crc_32.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/binary_fields.hpp"

namespace roci::planner::utility_htn::reading {

namespace {

const std::string kAgain = "; have it sent again, or pack it again with 'roci-network pack'";

[[noreturn]] void fail_at(std::size_t offset, const std::string& what) {
  throw BinaryError("at byte " + std::to_string(offset) + ": " + what);
}

std::int64_t unzigzag(std::uint64_t value) {
  return static_cast<std::int64_t>(value >> 1U) ^ -static_cast<std::int64_t>(value & 1U);
}

class ByteReader {
 public:
  template <typename T>
  using Of = T&;

  // `start` is the offset of the bytes in the file.
  ByteReader(std::string_view bytes, std::size_t start) : bytes_(bytes), start_(start) {}

  [[noreturn]] void fail(const std::string& what) const { fail_at(start_ + at_, what + kAgain); }
  std::size_t left() const { return bytes_.size() - at_; }
  std::size_t offset() const { return start_ + at_; }

  std::uint64_t varint() {
    std::uint64_t out = 0;
    for (unsigned shift = 0; shift < 70; shift += 7) {
      if (left() == 0) fail("the bytes end in a number");
      const auto byte = static_cast<unsigned char>(bytes_[at_++]);
      if (shift == 63 && byte > 1) break;
      out |= static_cast<std::uint64_t>(byte & 0x7fU) << shift;
      if (byte < 0x80) return out;
    }
    fail("a number is larger than 64 bits");
  }

  template <typename Number>
  void number(Number& out) {
    const std::uint64_t value = varint();
    if (value > std::numeric_limits<Number>::max()) fail("a number is too large for what it stands for");
    out = static_cast<Number>(value);
  }

  void whole(std::int32_t& out) {
    const std::int64_t value = unzigzag(varint());
    if (value != static_cast<std::int32_t>(value)) fail("a number is too large for what it stands for");
    out = static_cast<std::int32_t>(value);
  }

  void flag(bool& out) {
    const std::uint64_t value = varint();
    if (value > 1) fail("neither yes nor no");
    out = value == 1;
  }

  template <typename E>
  void enumeration(E& out, std::uint64_t count) {
    const std::uint64_t value = varint();
    if (value >= count) fail("a kind that is not known");
    out = static_cast<E>(value);
  }

  void real(double& out) {
    const std::uint64_t head = varint();
    if (head == 1 || head == 2) {
      out = head == 1 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
    } else if (head > 2) {
      out = static_cast<double>(unzigzag(head - 3));
    } else {
      if (left() < 8) fail("the bytes end in a number");
      const std::uint64_t bits = bytes::little_endian(bytes_.substr(at_, 8));
      at_ += 8;
      std::memcpy(&out, &bits, sizeof out);
      if (std::isnan(out)) fail("what should be a number is none");
    }
  }

  void time(temporal::Duration& out) {
    const std::uint64_t value = varint();
    out = value == 0 ? temporal::no_bound : temporal::Duration{unzigzag(value - 1)};
    if (out.count() == std::numeric_limits<std::int64_t>::min()) fail("a time is too large");
  }

  void text(std::string& out) {
    const std::uint64_t value = varint();
    if (value >= texts_.size()) fail("a text that is not there");
    copied_ += texts_[value].size();  // one text may be used many times
    if (copied_ > 4 * model::kMostBytes) fail("the texts would take too much memory");
    out = texts_[value];
  }

  void scores(temporal::RankVector& out) {
    std::vector<double> scores(count(model::kMostRanks));
    for (double& score : scores) real(score);
    out = temporal::RankVector(std::move(scores));
  }

  template <typename T>
  void list(std::vector<T>& out, std::size_t most) {
    const std::size_t size = count(most);
    for (std::size_t i = 0; i < size; ++i) one(out.emplace_back());
  }

  template <typename T>
  void optional(std::optional<T>& out) {
    bool there = false;
    flag(there);
    if (there) one(out.emplace());
  }

  void read_texts() {
    const std::size_t size = count(model::kMostBytes);
    for (std::size_t i = 0; i < size; ++i) {
      const std::uint64_t length = varint();
      if (length > model::kLongestText)
        fail("a text is longer than " + std::to_string(model::kLongestText) + " bytes");
      if (length > left()) fail("the bytes end in a text");
      texts_.emplace_back(bytes_.substr(at_, length));
      at_ += length;
    }
  }

 private:
  // Each item takes one byte at least, so what is left bounds a count before anything is made.
  std::size_t count(std::size_t most) {
    const std::uint64_t value = varint();
    if (value > most)
      fail("a list of " + std::to_string(value) + " items, at most " + std::to_string(most) +
           " are permitted");
    if (value > left())
      fail("a list of " + std::to_string(value) + " items in " + std::to_string(left()) + " bytes");
    items_ += value;
    if (items_ > 2 * model::kMostItems + model::kMostBytes / 64) fail("too many items in all lists together");
    return static_cast<std::size_t>(value);
  }

  void one(std::uint32_t& value) { number(value); }
  void one(std::string& value) { text(value); }
  template <typename T>
  void one(T& value) {
    fields(*this, value);
  }

  std::string_view bytes_;
  std::size_t start_;
  std::size_t at_ = 0;
  std::size_t items_ = 0;
  std::size_t copied_ = 0;
  std::vector<std::string> texts_;
};

}  // namespace

bool is_binary(std::string_view bytes) { return bytes.starts_with(kBinaryMagic); }

model::Network parse_binary(std::string_view bytes) {
  constexpr std::size_t kHead = kBinaryMagic.size() + 1;
  if (!is_binary(bytes))
    fail_at(0, "no network in binary form: it does not begin with '" + std::string(kBinaryMagic) +
                   "'; pack one with 'roci-network pack'");
  if (bytes.size() > model::kMostBytes)
    fail_at(model::kMostBytes,
            "more than " + std::to_string(model::kMostBytes) + " bytes; make the network smaller");
  if (bytes.size() <= kHead) fail_at(bytes.size(), "the bytes end in the head" + kAgain);
  const auto version = static_cast<unsigned char>(bytes[kHead - 1]);
  if (version != kBinaryFormat)
    fail_at(kHead - 1, "version " + std::to_string(version) + " of the form; version " +
                           std::to_string(kBinaryFormat) +
                           " is read here; pack it with the program of this build");
  ByteReader head(bytes.substr(kHead), kHead);
  const std::uint64_t length = head.varint();
  const std::size_t body = head.offset();
  if (bytes.size() - body < kChecksumBytes || length != bytes.size() - body - kChecksumBytes)
    fail_at(kHead, "the head speaks of " + std::to_string(length) + " bytes, and " +
                       std::to_string(bytes.size() - body) + " follow with the checksum" + kAgain);
  const std::uint64_t stated = bytes::little_endian(bytes.substr(body + length));
  if (stated != bytes::crc_32(bytes.substr(0, body + length)))
    fail_at(body + length, "the checksum is another: some of the bytes were changed" + kAgain);
  ByteReader reader(bytes.substr(body, length), body);
  reader.read_texts();
  model::Network out;
  fields(reader, out);
  if (reader.left() != 0) reader.fail(std::to_string(reader.left()) + " bytes too many");
  return out;
}

}  // namespace roci::planner::utility_htn::reading
