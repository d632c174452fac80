#include "core/mission/nearest_word.hpp"

#include <algorithm>
#include <cstddef>

namespace roci::mission {
namespace {

constexpr std::size_t kLongest = 200;  // letters of a word that is looked at

std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last;
  std::vector<std::size_t> last(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::vector<std::size_t> row(b.size() + 1, i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = std::move(last);
    last = std::move(row);
  }
  return last.back();
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& known) {
  std::string best;
  std::size_t fewest = 0;
  if (word.size() > kLongest) return best;
  for (const std::string& one : known) {
    if (one.empty() || one.size() > kLongest) continue;
    const std::size_t allowed = std::max<std::size_t>(1, std::max(word.size(), one.size()) / 3);
    const std::size_t slips = slips_between(word, one);
    if (slips > allowed || slips >= std::max(word.size(), one.size()) || (!best.empty() && slips >= fewest))
      continue;
    best = one;
    fewest = slips;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? "" : "; did you mean '" + nearest + "'?";
}

}  // namespace roci::mission
