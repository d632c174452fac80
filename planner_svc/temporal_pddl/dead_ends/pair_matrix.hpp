// A pair matrix is a symmetric relation over small numbers, kept as rows of bits.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roci::planner::temporal_pddl::dead_ends {

using BitWord = std::uint64_t;

/// Holds a set of small numbers.
class Bits {
 public:
  Bits() = default;
  explicit Bits(std::size_t size) : words_((size + 63) / 64, 0) {}

  bool has(std::size_t i) const { return (words_[i / 64] >> (i % 64) & 1) != 0; }
  void set(std::size_t i) { words_[i / 64] |= BitWord{1} << (i % 64); }
  void clear(std::size_t i) { words_[i / 64] &= ~(BitWord{1} << (i % 64)); }
  void clear(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) clear(i);
  }
  void clear_all() { words_.assign(words_.size(), 0); }
  void keep(std::span<const BitWord> others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= others[i];
  }
  void leave_out(std::span<const BitWord> others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] &= ~others[i];
  }
  std::span<const BitWord> words() const { return words_; }

 private:
  std::vector<BitWord> words_;
};

/// Holds a relation over the numbers 0 … size − 1 that is symmetric at all times.
class PairMatrix {
 public:
  PairMatrix() = default;
  explicit PairMatrix(std::size_t size) : words_((size + 63) / 64), bits_(words_ * size, 0) {}
  static std::size_t bytes(std::size_t size) { return (size + 63) / 64 * size * sizeof(BitWord); }

  bool empty() const { return bits_.empty(); }
  std::size_t row_words() const { return words_; }
  bool has(std::size_t a, std::size_t b) const { return (bits_[a * words_ + b / 64] >> (b % 64) & 1) != 0; }
  void set(std::size_t a, std::size_t b) {
    set_one(a, b);
    set_one(b, a);
  }
  std::span<const BitWord> row(std::size_t a) const { return {bits_.data() + a * words_, words_}; }
  /// Relates `a` to all of `others` that it is not related to yet, and calls visit(b) for each of these.
  template <typename Visit>
  void add(std::size_t a, std::span<const BitWord> others, const Visit& visit) {
    for (std::size_t w = 0; w < words_; ++w) {
      BitWord news = others[w] & ~bits_[a * words_ + w];
      bits_[a * words_ + w] |= news;
      for (; news != 0; news &= news - 1) {
        const std::size_t b = w * 64 + static_cast<std::size_t>(std::countr_zero(news));
        set_one(b, a);
        visit(b);
      }
    }
  }
  std::size_t bytes() const { return bits_.capacity() * sizeof(BitWord); }

 private:
  void set_one(std::size_t a, std::size_t b) { bits_[a * words_ + b / 64] |= BitWord{1} << (b % 64); }

  std::size_t words_ = 0;
  std::vector<BitWord> bits_;
};

}  // namespace roci::planner::temporal_pddl::dead_ends
