// FNV-1a hashes bytes into 64 bits that are equal on every machine, which std::hash does not promise. It stands
// where equal values must be recognised or texts must become seeds, and guards short records; somebody who wants
// a collision finds one.
#pragma once

#include <cstdint>
#include <string_view>

namespace roci::bytes {

/// Computes the 64-bit FNV-1a hash (Fowler, Noll, Vo; draft-eastlake-fnv) of what is given piece by piece. Two
/// pieces hash as their concatenation does: who hashes several texts adds their sizes, too. The high bits of
/// short inputs are not uniform; pseudorandom::finalized() makes them so.
class Fnv1a {
 public:
  constexpr Fnv1a() = default;
  /// Starts from the offset basis with the bits of a seed flipped; the seed 0 gives the published hash.
  constexpr explicit Fnv1a(std::uint64_t seed) : hash_(kOffsetBasis ^ seed) {}

  constexpr Fnv1a& add(std::string_view bytes) {
    for (const char c : bytes) add_byte(static_cast<unsigned char>(c));
    return *this;
  }
  /// Adds the eight bytes of a number, the lowest first.
  constexpr Fnv1a& add_number(std::uint64_t number) {
    for (int shift = 0; shift < 64; shift += 8) add_byte(static_cast<unsigned char>(number >> shift));
    return *this;
  }
  constexpr std::uint64_t value() const { return hash_; }

 private:
  static constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325U;
  static constexpr std::uint64_t kPrime = 0x100000001b3U;

  constexpr void add_byte(unsigned char byte) { hash_ = (hash_ ^ byte) * kPrime; }

  std::uint64_t hash_ = kOffsetBasis;
};

/// Returns the FNV-1a hash of bytes that are there as a whole.
constexpr std::uint64_t fnv_1a(std::string_view bytes) { return Fnv1a().add(bytes).value(); }

}  // namespace roci::bytes
