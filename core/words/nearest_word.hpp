// This file finds the known word that somebody may have meant with an unknown one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace roci::words {

/// Keeps the nearest of the known words that it is offered one by one, by the optimal string alignment distance
/// (Damerau's edits: a character too many, missing, wrong, or two exchanged). A word counts as near with one edit for
/// each three characters of the longer one, at least one, but not if all its characters are edited; of equally near
/// ones the first counts. Words of over 200 characters are not compared.
class NearestWord {
 public:
  explicit NearestWord(std::string_view word);

  void offer(std::string_view known);
  /// Returns the nearest word, or nothing.
  const std::string& found() const { return found_; }
  /// Returns "did you mean 'found'? else OTHERWISE", or only `otherwise` if nothing is near.
  std::string remedy(std::string_view otherwise) const;

 private:
  std::string word_;
  std::size_t fewest_;  // edits of the word that was found
  std::string found_;
};

/// Offers the words of a range.
template <typename Words>
NearestWord nearest(std::string_view word, const Words& known) {
  NearestWord found(word);
  for (const auto& one : known) found.offer(one);
  return found;
}

/// Returns the nearest of the known words, or nothing.
std::string nearest_word(std::string_view word, const std::vector<std::string>& known);

/// Returns "; did you mean 'drive'?", to be put behind the list of what is known, or nothing where no word is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace roci::words
