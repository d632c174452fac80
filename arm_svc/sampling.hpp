// Seeded joint vectors are the only randomness in this folder, and always come from a generator that the
// caller seeded.
#pragma once

#include <cstdint>
#include <random>

#include "core/kinematics/arm.hpp"

namespace roci::arm {

/// Returns a number uniform in [0, 1), the same on every standard library.
inline double unit_sample(std::mt19937_64& rng) { return static_cast<double>(rng() >> 11) * 0x1p-53; }

/// Returns joint values uniform within the position limits.
kinematics::JointVector sample_coordinates(const kinematics::Arm& arm, std::mt19937_64& rng);

/// Returns a seed that depends on the bits of both vectors and on nothing that happened before.
std::uint64_t query_seed(const kinematics::JointVector& from, const kinematics::JointVector& to);

}  // namespace roci::arm
