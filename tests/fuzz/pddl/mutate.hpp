// Seeded changes of a text that keep it nearly well formed.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace roci::fuzz {

// One to four random changes: bytes flipped, inserted, deleted; pieces doubled, exchanged or taken from
// another text; words of the language inserted; lists nested.
std::string mutate(std::string text, const std::vector<std::string>& corpus, std::mt19937_64& random);

}  // namespace roci::fuzz
