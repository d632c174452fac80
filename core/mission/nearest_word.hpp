// What was probably meant by a word that nobody knows.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roci::mission {

/// The known word that is the fewest typing slips away (a letter more, less, another, or two swapped: the
/// optimal string alignment distance), if that is at most a third of its letters, and one slip in short
/// words; empty if none is so near. Of equals the first.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// "; did you mean 'drive'?", to be put behind the list of what is known; empty where no word is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace roci::mission
