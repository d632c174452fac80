#include "tests/fuzz/missions/mutate.hpp"

#include <array>
#include <cctype>
#include <cstddef>
#include <functional>
#include <vector>

namespace roci::fuzz {
namespace {

struct Piece {
  std::size_t begin, length;
};

// The longest runs of characters that `belongs`.
std::vector<Piece> pieces(const std::string& text, const std::function<bool(unsigned char)>& belongs) {
  std::vector<Piece> out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && belongs(static_cast<unsigned char>(text[end]))) ++end;
    if (end > i) out.push_back({i, end - i});
    i = end + 1;
  }
  return out;
}

std::vector<Piece> lines(const std::string& text) {
  return pieces(text, [](unsigned char c) { return c != '\n'; });
}
std::vector<Piece> words(const std::string& text) {
  return pieces(text, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; });
}
std::vector<Piece> numbers(const std::string& text) {
  return pieces(text, [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; });
}

class Damage {
 public:
  Damage(std::string text, std::mt19937_64& random) : text_(std::move(text)), random_(random) {}

  void once() {
    switch (below(8)) {
      case 0:
        return replace_one(lines(text_), "");
      case 1:
        return exchange(lines(text_));
      case 2:
        return exchange(words(text_));
      case 3:
      case 4:
        return replace_one(numbers(text_), kAbsurd[below(kAbsurd.size())]);
      case 5:
        return flip_bytes();
      case 6:
        return repeat_line();
      default:
        text_.resize(below(text_.size() + 1));
    }
  }

  std::string take() { return std::move(text_); }

 private:
  static constexpr std::array<const char*, 12> kAbsurd{
      "-1",     "0", "1e999", "nan", ".inf", "99999999999999999999",
      "1e-320", "",  "0x",    "[]",  "{}",   "2147483648"};

  std::size_t below(std::size_t bound) { return bound == 0 ? 0 : random_() % bound; }

  void replace_one(const std::vector<Piece>& choices, const std::string& by) {
    if (choices.empty()) return;
    const Piece piece = choices[below(choices.size())];
    text_.replace(piece.begin, piece.length, by);
  }

  void exchange(const std::vector<Piece>& choices) {
    if (choices.empty()) return;
    const Piece from = choices[below(choices.size())];
    replace_one(choices, text_.substr(from.begin, from.length));
  }

  void repeat_line() {
    const auto choices = lines(text_);
    if (choices.empty()) return;
    const Piece piece = choices[below(choices.size())];
    text_.insert(piece.begin, text_.substr(piece.begin, piece.length) + "\n");
  }

  void flip_bytes() {
    for (std::size_t i = 0; i < 4 && !text_.empty(); ++i)
      text_[below(text_.size())] = static_cast<char>(random_());
  }

  std::string text_;
  std::mt19937_64& random_;
};

}  // namespace

std::string damage(std::string text, std::mt19937_64& random) {
  Damage damage(std::move(text), random);
  for (std::size_t count = 1 + random() % 3; count > 0; --count) damage.once();
  return damage.take();
}

}  // namespace roci::fuzz
