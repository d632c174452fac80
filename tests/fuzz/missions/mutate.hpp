// Seeded damage to a file, of the kinds that people and disks do.
#pragma once

#include <random>
#include <string>

namespace roci::fuzz {

// One to three of: a line lost, doubled or swapped with another; a number made absurd; a word replaced by
// another of the file; bytes flipped; the rest cut off.
std::string damage(std::string text, std::mt19937_64& random);

}  // namespace roci::fuzz
