#include "core/words/nearest_word.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace roci::words {

namespace {

constexpr std::size_t kLongest = 200;  // characters

std::size_t edits_allowed(std::size_t length) {
  return std::min(std::max<std::size_t>(1, length / 3), length - 1);
}

std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    std::swap(before_last, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

NearestWord::NearestWord(std::string_view word)
    : word_(word.substr(0, kLongest + 1)), fewest_(std::numeric_limits<std::size_t>::max()) {}

void NearestWord::offer(std::string_view known) {
  if (known.empty() || word_.empty() || std::max(known.size(), word_.size()) > kLongest) return;
  const std::size_t shorter = std::min(known.size(), word_.size()),
                    longer = std::max(known.size(), word_.size());
  const std::size_t allowed = edits_allowed(longer);
  if (longer - shorter > allowed) return;
  const std::size_t edits = distance(word_, known);
  if (edits == 0 || edits > allowed || edits >= fewest_) return;
  found_ = known;
  fewest_ = edits;
}

std::string NearestWord::remedy(std::string_view otherwise) const {
  if (found_.empty()) return std::string(otherwise);
  return "did you mean '" + found_ + "'? else " + std::string(otherwise);
}

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  return nearest(word, known).found();
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string found = nearest_word(word, known);
  return found.empty() ? "" : "; did you mean '" + found + "'?";
}

}  // namespace roci::words
