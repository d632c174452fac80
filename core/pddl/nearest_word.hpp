// Finds the known word that somebody may have meant with an unknown one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace roci::pddl {

/// Is offered the known words one by one and keeps the nearest, by the optimal string alignment distance (Damerau's edits:
/// a character too many, missing, wrong, or two exchanged). A word counts as near with one edit from 3 characters on, with
/// two from 5, with three from 9; of equally near ones the first counts.
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
  std::size_t limit_;  // edits that are still near
  std::string found_;
};

/// Offers the words of a range.
template <typename Words>
NearestWord nearest(std::string_view word, const Words& known) {
  NearestWord found(word);
  for (const auto& one : known) found.offer(one);
  return found;
}

}  // namespace roci::pddl
