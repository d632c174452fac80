// An oracle for networks.
#pragma once

#include <algorithm>
#include <vector>

#include "core/temporal/stn.hpp"

namespace roci::temporal {

/// Shortest paths between all points: the textbook consistency check.
class FloydWarshall {
 public:
  explicit FloydWarshall(std::size_t n) : n_(n), d_(n * n, no_bound) {
    for (std::size_t i = 0; i < n; ++i) at(i, i) = Duration{0};
  }

  bool add(std::size_t from, std::size_t to, Duration lower, Duration upper) {
    const std::vector<Duration> before = d_;
    at(from, to) = std::min(at(from, to), upper);
    at(to, from) = std::min(at(to, from), -lower);
    for (std::size_t k = 0; k < n_; ++k)
      for (std::size_t i = 0; i < n_; ++i)
        for (std::size_t j = 0; j < n_; ++j)
          if (bounded(at(i, k)) && bounded(at(k, j))) at(i, j) = std::min(at(i, j), at(i, k) + at(k, j));
    for (std::size_t i = 0; i < n_; ++i) {
      if (at(i, i) >= Duration{0}) continue;
      d_ = before;
      return false;
    }
    return true;
  }

  Window window(std::size_t point) { return between(0, point); }
  Window between(std::size_t from, std::size_t to) { return {-at(to, from), at(from, to)}; }

 private:
  Duration& at(std::size_t i, std::size_t j) { return d_[i * n_ + j]; }
  std::size_t n_;
  std::vector<Duration> d_;
};

}  // namespace roci::temporal
