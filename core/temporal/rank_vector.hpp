// Utility goes by rank (MEXEC, section IV.C.1, R113): scores of the same rank add up, and any gain of a
// higher rank outweighs every gain of the lower ones.
#pragma once

#include <compare>
#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

namespace roci::temporal {

/// Holds scores by rank, the highest rank first. A rank that is not there counts as 0, so that vectors of any
/// two lengths can be compared and added. What the ranks mean, and the range of a score, is the mission's to
/// say.
class RankVector {
 public:
  RankVector() = default;
  RankVector(std::initializer_list<double> scores) : scores_(scores) { trim(); }
  explicit RankVector(std::vector<double> scores) : scores_(std::move(scores)) { trim(); }

  double operator[](std::size_t rank) const { return rank < scores_.size() ? scores_[rank] : 0.0; }
  /// Returns the scores without the zeros at the end: equal vectors have equal scores.
  const std::vector<double>& scores() const { return scores_; }
  /// Returns whether no score is infinite or not a number; vectors with such a score have no order.
  bool finite() const;

  RankVector& operator+=(const RankVector& other);
  RankVector& operator-=(const RankVector& other);
  /// Multiplies each score by the same factor, for example to utility per energy (Z12).
  RankVector& operator*=(double factor);

  friend RankVector operator+(RankVector a, const RankVector& b) { return a += b; }
  friend RankVector operator-(RankVector a, const RankVector& b) { return a -= b; }
  friend RankVector operator*(RankVector a, double factor) { return a *= factor; }

  /// Compares lexicographically from the highest rank on; vectors are unordered where a score that decides is
  /// not a number.
  friend std::partial_ordering operator<=>(const RankVector& a, const RankVector& b);
  friend bool operator==(const RankVector&, const RankVector&) = default;

 private:
  void trim();

  std::vector<double> scores_;
};

/// Prints "0", "0.5" or "[1, 0, 0.25]"; one rank is a plain number.
std::string to_text(const RankVector& utility);

}  // namespace roci::temporal
