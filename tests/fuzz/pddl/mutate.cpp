#include "tests/fuzz/pddl/mutate.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace roci::fuzz {

namespace {

constexpr std::array<std::string_view, 40> kWords = {"(",
                                                     ")",
                                                     "()",
                                                     " - ",
                                                     "either",
                                                     "?x",
                                                     "?duration",
                                                     "#t",
                                                     "(and ",
                                                     "(or ",
                                                     "(not ",
                                                     "(forall (?x) ",
                                                     "(exists (?y - t) ",
                                                     "(when ",
                                                     "(imply ",
                                                     "(at start ",
                                                     "(at end ",
                                                     "(over all ",
                                                     "(at 5 ",
                                                     "(= ",
                                                     "(>= ",
                                                     "(+ 1 ",
                                                     "(/ 1 ",
                                                     "(assign (f) ",
                                                     ":action",
                                                     ":derived",
                                                     ":modules",
                                                     ":init",
                                                     ":goal",
                                                     ":metric",
                                                     ":types",
                                                     ":constants",
                                                     "1e308",
                                                     "-0.0",
                                                     "99999999999999999999",
                                                     "nan",
                                                     ";",
                                                     "\n",
                                                     "[2]",
                                                     ": (act a1)"};

class Mutator {
 public:
  Mutator(const std::vector<std::string>& corpus, std::mt19937_64& random)
      : corpus_(corpus), random_(random) {}

  void change(std::string& text) {
    const std::size_t place = below(text.size() + 1);
    const std::size_t length = below(std::min<std::size_t>(text.size() - place, 60) + 1);
    switch (below(14)) {
      case 0:
        if (place < text.size()) text[place] = static_cast<char>(below(256));
        break;
      case 1:
        text.insert(place, 1, static_cast<char>(below(128)));
        break;
      case 2:
        text.erase(place, length);
        break;
      case 3:
        text.insert(place, std::string(text, place, length));
        break;
      case 4:
        text.insert(place, piece_of(corpus_[below(corpus_.size())]));
        break;
      case 5:
        text.insert(place, kWords[below(kWords.size())]);
        break;
      case 6:
        nest(text, place);
        break;
      default:
        replace_word(text, place);
    }
  }

  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

 private:
  std::string piece_of(const std::string& text) {
    const std::size_t place = below(text.size());
    return text.substr(place, below(80));
  }

  // Puts a word of some text in the place of a word: what comes out often still parses.
  void replace_word(std::string& text, std::size_t place) {
    static constexpr std::string_view kEnds = " ()\n";
    const std::size_t begin = std::min(text.find_first_not_of(kEnds, place), text.size());
    const std::size_t end = std::min(text.find_first_of(kEnds, begin), text.size());
    const std::string& other = corpus_[below(corpus_.size())];
    const std::size_t from = std::min(other.find_first_not_of(kEnds, below(other.size())), other.size());
    const std::size_t to = std::min(other.find_first_of(kEnds, from), other.size());
    text.replace(begin, end - begin, other, from, to - from);
  }

  void nest(std::string& text, std::size_t place) {
    static constexpr std::array<std::string_view, 3> kOpen = {"(", "(not ", "(and "};
    const std::string_view open = kOpen[below(kOpen.size())];
    std::string opened;
    const std::size_t depth = below(300);
    for (std::size_t i = 0; i < depth; ++i) opened += open;
    text.insert(place, opened);
    if (below(2) == 0)
      text.insert(std::min(text.size(), place + opened.size() + below(20)), std::string(depth, ')'));
  }

  const std::vector<std::string>& corpus_;
  std::mt19937_64& random_;
};

}  // namespace

std::string mutate(std::string text, const std::vector<std::string>& corpus, std::mt19937_64& random) {
  Mutator mutator(corpus, random);
  const std::size_t most = mutator.below(2) == 0 ? 1 : 4;
  for (std::size_t changes = 1 + mutator.below(most); changes > 0; --changes) mutator.change(text);
  return text;
}

}  // namespace roci::fuzz
