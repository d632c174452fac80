// A fingerprint is 64 bits of values: equal values have an equal fingerprint, on every run and host.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

#include "core/bytes/fnv_1a.hpp"

namespace roci::arm {

/// Takes values one after the other; their order counts.
class Fingerprint {
 public:
  Fingerprint& add(std::string_view text);
  Fingerprint& add(double value);
  Fingerprint& add(std::uint64_t value);

  template <typename Derived>
  Fingerprint& add(const Eigen::DenseBase<Derived>& values) {
    for (Eigen::Index column = 0; column < values.cols(); ++column) {
      for (Eigen::Index row = 0; row < values.rows(); ++row) add(static_cast<double>(values(row, column)));
    }
    return *this;
  }

  std::uint64_t value() const { return hash_.value(); }

 private:
  bytes::Fnv1a hash_;
};

}  // namespace roci::arm
