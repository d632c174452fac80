#include "core/pddl/sexpr.hpp"

#include <charconv>
#include <cmath>

namespace roci::pddl {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

bool is_word_character(char c) { return c > ' ' && c < '\x7f' && c != '(' && c != ')' && c != ';'; }

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string describe_byte(char c) {
  static constexpr char kHex[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

class Reader {
 public:
  Reader(std::string_view text, std::string_view file) : text_(text), file_(file) {}

  // Keeps the open lists on a stack of its own, so that hostile nesting meets the limit and not the machine's
  // stack.
  Sexpr read() {
    std::vector<Sexpr> open;
    for (skip_blank(); !at_end(); skip_blank()) {
      if (peek() == '(') {
        if (open.size() >= kMaxNesting) {
          fail(here_, "parentheses are nested deeper than " + std::to_string(kMaxNesting),
               "flatten the formula");
        }
        Sexpr list;
        list.is_list = true;
        list.where = here_;
        open.push_back(std::move(list));
        advance();
      } else if (peek() == ')') {
        if (open.empty()) fail(here_, "')' without '('", "remove it or open the list");
        Sexpr done = std::move(open.back());
        open.pop_back();
        done.closed = here_;
        advance();
        if (open.empty()) return finish(std::move(done));
        open.back().items.push_back(std::move(done));
      } else if (open.empty()) {
        fail(here_, "text outside of any parentheses", "the file is one list: (define …)");
      } else {
        open.back().items.push_back(read_word());
      }
    }
    if (open.empty()) fail(here_, "empty input", "the file is one list: (define …)");
    fail(open.back().where, "'(' is never closed", "add the missing ')'");
  }

 private:
  Sexpr finish(Sexpr list) {
    skip_blank();
    if (!at_end()) fail(here_, "text after the end of the list", "one file holds one (define …)");
    return list;
  }

  Sexpr read_word() {
    Sexpr word;
    word.where = here_;
    const bool glued_type = peek() == '-' && next_ + 1 < text_.size() && is_letter(text_[next_ + 1]);
    while (!at_end() && is_word_character(peek())) {
      word.word += lower(peek());
      advance();
      if (glued_type) break;  // "?x -t" is "?x - t"
    }
    if (word.word.empty()) {
      fail(here_, describe_byte(peek()) + " outside of a comment", "PDDL names are plain ASCII");
    }
    return word;
  }

  void skip_blank() {
    while (!at_end()) {
      if (peek() == ';') {
        while (!at_end() && peek() != '\n') advance();
      } else if (is_space(peek())) {
        advance();
      } else {
        return;
      }
    }
  }

  bool at_end() const { return next_ == text_.size(); }
  char peek() const { return text_[next_]; }

  void advance() {
    if (text_[next_++] == '\n') {
      ++here_.line;
      here_.column = 1;
    } else {
      ++here_.column;
    }
  }

  [[noreturn]] void fail(SourceLocation where, std::string message, std::string remedy) const {
    throw ParseError({std::string(file_), where, std::move(message), std::move(remedy)});
  }

  std::string_view text_;
  std::string_view file_;
  std::size_t next_ = 0;
  SourceLocation here_{1, 1};
};

}  // namespace

std::string_view Sexpr::head() const {
  return is_list && !items.empty() && !items.front().is_list ? std::string_view(items.front().word)
                                                             : std::string_view();
}

Sexpr read_sexpr(std::string_view text, std::string_view file) { return Reader(text, file).read(); }

std::optional<double> as_number(std::string_view word) {
  std::string_view digits = word;
  if (!digits.empty() && (digits.front() == '+' || digits.front() == '-')) digits.remove_prefix(1);
  if (digits.empty() || !(digits.front() == '.' || (digits.front() >= '0' && digits.front() <= '9')))
    return {};
  const bool negative = word.front() == '-';
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value)) return {};
  return negative ? -value : value;
}

}  // namespace roci::pddl
