// Random terrain is made in whole numbers, so that a seed gives the same site on every machine.
#pragma once

#include <cstdint>

namespace roci::terrain {

/// Returns value noise on a square lattice, in integers throughout: random values at the lattice points,
/// blended by 3t² − 2t³ between them. `wavelength` is the lattice spacing, `amplitude` the largest absolute
/// value; both, the position and the result are in millimetres.
std::int64_t lattice_noise(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t wavelength,
                           std::int64_t amplitude);

}  // namespace roci::terrain
