#include "core/pddl/nearest_word.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace roci::pddl {

namespace {

constexpr std::size_t kLongest = 64;  // characters; longer words are not compared

std::size_t edits_allowed(std::size_t length) {
  if (length < 3 || length > kLongest) return 0;
  return length < 5 ? 1 : length < 9 ? 2 : 3;
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
    : word_(word.substr(0, kLongest + 1)), limit_(edits_allowed(word.size())) {}

void NearestWord::offer(std::string_view known) {
  if (limit_ == 0 || known.empty() || known.size() > word_.size() + limit_ ||
      word_.size() > known.size() + limit_)
    return;
  const std::size_t edits = distance(word_, known);
  if (edits > limit_ || edits == 0) return;
  found_ = known;
  limit_ = edits - 1;
}

std::string NearestWord::remedy(std::string_view otherwise) const {
  if (found_.empty()) return std::string(otherwise);
  return "did you mean '" + found_ + "'? else " + std::string(otherwise);
}

}  // namespace roci::pddl
