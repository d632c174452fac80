// The archive turns plain values into bytes and back, exactly: every double and every string, also one that
// is no text. The fields of each type are listed once, beside it (*_fields.hpp), for both ways.
#pragma once

#include <bit>
#include <chrono>
#include <concepts>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace roci::exec::archive {

/// Reports bytes that no Writer wrote.
class ArchiveError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Turns values into bytes, one after the other.
class Writer {
 public:
  static constexpr bool writes = true;

  template <class... Ts>
  void operator()(const Ts&... values) {
    (put(values), ...);
  }
  std::string take() { return std::exchange(bytes_, {}); }

 private:
  void number(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) bytes_ += static_cast<char>(value | 0x80);
    bytes_ += static_cast<char>(value);
  }
  template <class T>
  requires std::integral<T> || std::is_enum_v<T>
  void put(T value) {
    /// The zigzag form keeps small numbers of either sign short.
    const auto wide = static_cast<std::int64_t>(value);
    number(static_cast<std::uint64_t>(wide) << 1 ^ static_cast<std::uint64_t>(wide >> 63));
  }
  void put(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (int shift = 0; shift < 64; shift += 8) bytes_ += static_cast<char>(bits >> shift);
  }
  void put(std::monostate) {}
  void put(const std::string& text) {
    number(text.size());
    bytes_ += text;
  }
  template <class Period>
  void put(std::chrono::duration<std::int64_t, Period> value) {
    put(value.count());
  }
  template <class T>
  void put(const std::vector<T>& values) {
    number(values.size());
    for (const T& value : values) put(value);
  }
  template <class K, class V>
  void put(const std::map<K, V>& values) {
    number(values.size());
    for (const auto& [key, value] : values) (*this)(key, value);
  }
  template <class T>
  void put(const std::set<T>& values) {
    number(values.size());
    for (const T& value : values) put(value);
  }
  template <class T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <class... Ts>
  void put(const std::variant<Ts...>& value) {
    number(value.index());
    std::visit([this](const auto& held) { put(held); }, value);
  }
  template <class T>
  requires std::is_class_v<T>
  void put(const T& value) { fields(*this, value); }

  std::string bytes_;
};

/// Turns the bytes of a Writer back into values, in the same order.
class Reader {
 public:
  static constexpr bool writes = false;

  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  /// Reads the values. Throws ArchiveError.
  template <class... Ts>
  void operator()(Ts&... values) {
    (get(values), ...);
  }
  void finish() const {
    if (!rest_.empty()) throw ArchiveError("bytes are left over");
  }

 private:
  std::uint8_t byte() {
    if (rest_.empty()) throw ArchiveError("bytes are missing");
    const auto out = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return out;
  }
  std::uint64_t number() {
    std::uint64_t out = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      const std::uint8_t next = byte();
      out |= static_cast<std::uint64_t>(next & 0x7F) << shift;
      if (next < 0x80) return out;
    }
    throw ArchiveError("a number has no end");
  }
  std::size_t count() {
    const std::uint64_t out = number();
    if (out > rest_.size()) throw ArchiveError("bytes are missing");  // each element takes one at least
    return static_cast<std::size_t>(out);
  }
  template <class T>
  requires std::integral<T> || std::is_enum_v<T>
  void get(T& value) {
    const std::uint64_t folded = number();
    value = static_cast<T>(static_cast<std::int64_t>(folded >> 1 ^ (~(folded & 1) + 1)));
  }
  void get(double& value) {
    std::uint64_t bits = 0;
    for (int shift = 0; shift < 64; shift += 8) bits |= static_cast<std::uint64_t>(byte()) << shift;
    value = std::bit_cast<double>(bits);
  }
  void get(std::monostate) {}
  void get(std::string& text) {
    const std::size_t size = count();
    text = rest_.substr(0, size);
    rest_.remove_prefix(size);
  }
  template <class Period>
  void get(std::chrono::duration<std::int64_t, Period>& value) {
    std::int64_t ticks = 0;
    get(ticks);
    value = std::chrono::duration<std::int64_t, Period>(ticks);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.clear();
    for (std::size_t left = count(); left > 0; --left) get(values.emplace_back());
  }
  template <class T>
  void get(std::set<T>& values) {
    values.clear();
    for (std::size_t left = count(); left > 0; --left) {
      T value{};
      get(value);
      values.insert(std::move(value));
    }
  }
  template <class K, class V>
  void get(std::map<K, V>& values) {
    values.clear();
    for (std::size_t left = count(); left > 0; --left) {
      std::pair<K, V> entry;
      (*this)(entry.first, entry.second);
      values.insert(std::move(entry));
    }
  }
  template <class T>
  void get(std::optional<T>& value) {
    bool present = false;
    get(present);
    value.reset();
    if (present) get(value.emplace());
  }
  template <class... Ts>
  void get(std::variant<Ts...>& value) {
    alternative(value, number(), std::index_sequence_for<Ts...>{});
  }
  template <class... Ts, std::size_t... Is>
  void alternative(std::variant<Ts...>& value, std::uint64_t index, std::index_sequence<Is...>) {
    const bool known = ((Is == index ? (get(value.template emplace<Is>()), true) : false) || ...);
    if (!known) throw ArchiveError("a value is of no known kind");
  }
  template <class T>
  requires std::is_class_v<T>
  void get(T& value) { fields(*this, value); }

  std::string_view rest_;
};

/// Names the type of the second parameter of fields(archive, value): const where the archive writes.
template <class T, class Archive>
using Of = std::conditional_t<Archive::writes, const T, T>;

/// Returns the bytes of one value.
template <class T>
std::string to_bytes(const T& value) {
  Writer writer;
  writer(value);
  return writer.take();
}

/// Reads a value from bytes that hold nothing else. Throws ArchiveError.
template <class T>
T from_bytes(std::string_view bytes) {
  T out{};
  Reader reader(bytes);
  reader(out);
  reader.finish();
  return out;
}

}  // namespace roci::exec::archive
