// Seeded joint vectors: the only randomness in this folder, and always from a generator the caller seeded.
#pragma once

#include <cstdint>
#include <random>

#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Is uniform in [0, 1), the same on every standard library.
inline double unit_sample(std::mt19937_64& rng) { return static_cast<double>(rng() >> 11) * 0x1p-53; }

/// Is uniform within the position limits.
kinematics::JointVector sample_coordinates(const kinematics::Arm& arm, std::mt19937_64& rng);

/// Returns a seed that depends on the bits of both vectors and on nothing that happened before.
std::uint64_t query_seed(const kinematics::JointVector& from, const kinematics::JointVector& to);

}  // namespace roci::arm
