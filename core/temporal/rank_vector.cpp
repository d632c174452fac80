#include "core/temporal/rank_vector.hpp"

#include <algorithm>
#include <cmath>

#include "core/temporal/value.hpp"

namespace roci::temporal {

bool RankVector::finite() const {
  return std::ranges::all_of(scores_, [](double score) { return std::isfinite(score); });
}

RankVector& RankVector::operator+=(const RankVector& other) {
  scores_.resize(std::max(scores_.size(), other.scores_.size()));
  for (std::size_t rank = 0; rank < other.scores_.size(); ++rank) scores_[rank] += other.scores_[rank];
  trim();
  return *this;
}

RankVector& RankVector::operator-=(const RankVector& other) { return *this += other * -1.0; }

RankVector& RankVector::operator*=(double factor) {
  for (double& score : scores_) score *= factor;
  trim();
  return *this;
}

std::partial_ordering operator<=>(const RankVector& a, const RankVector& b) {
  for (std::size_t rank = 0; rank < std::max(a.scores_.size(), b.scores_.size()); ++rank) {
    const std::partial_ordering order = a[rank] <=> b[rank];
    if (order != std::partial_ordering::equivalent) return order;
  }
  return std::partial_ordering::equivalent;
}

void RankVector::trim() {
  while (!scores_.empty() && scores_.back() == 0.0) scores_.pop_back();
}

std::string to_text(const RankVector& utility) {
  const auto& scores = utility.scores();
  if (scores.size() <= 1) return to_text(Value{utility[0]});
  std::string out = "[";
  for (const double score : scores) out += (out.size() == 1 ? "" : ", ") + to_text(Value{score});
  return out + "]";
}

}  // namespace roci::temporal
