#include "rehearsal/check/words.hpp"

#include <algorithm>
#include <cstddef>

#include "core/words/nearest_word.hpp"

namespace roci::rehearsal::check {

std::string instead_of(std::string_view word, const std::vector<std::string>& known) {
  constexpr std::size_t kShown = 12;
  if (const std::string nearest = words::nearest_word(word, known); !nearest.empty())
    return "did you mean '" + nearest + "'?";
  std::string out = "known: ";
  for (std::size_t i = 0; i < std::min(known.size(), kShown); ++i) out += (i > 0 ? ", " : "") + known[i];
  if (known.size() > kShown) out += " and " + std::to_string(known.size() - kShown) + " more";
  return known.empty() ? "there is none" : out;
}

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

std::vector<std::string> slots_of(std::string_view text) {
  std::vector<std::string> out;
  for (std::size_t open = text.find('{'); open != std::string_view::npos; open = text.find('{', open + 1)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string_view::npos) break;
    out.emplace_back(text.substr(open + 1, close - open - 1));
  }
  return out;
}

}  // namespace roci::rehearsal::check
