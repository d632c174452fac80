#include "core/pddl/lexer.hpp"

#include <algorithm>
#include <array>

namespace roci::pddl {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Blanks and dashes that come along when text is copied from a page or a document, in UTF-8.
constexpr std::array<std::string_view, 6> kOddBlanks = {"\xc2\xa0",     "\xe2\x80\x8b", "\xe2\x80\x89",
                                                        "\xe2\x80\xaf", "\xe3\x80\x80", kByteOrderMark};
constexpr std::array<std::string_view, 4> kOddDashes = {"\xe2\x80\x90", "\xe2\x80\x93", "\xe2\x80\x94",
                                                        "\xe2\x88\x92"};

enum class Class : unsigned char {
  other,
  word,
  blank,
  line_feed,
  carriage_return,
  parenthesis,
  comment,
  comma
};

constexpr std::array<Class, 256> classes() {
  std::array<Class, 256> all{};
  for (std::size_t c = ' ' + 1; c < 0x7f; ++c) all[c] = Class::word;
  for (const char c : {' ', '\t', '\f', '\v'}) all[static_cast<unsigned char>(c)] = Class::blank;
  all['\n'] = Class::line_feed;
  all['\r'] = Class::carriage_return;
  all['('] = all[')'] = Class::parenthesis;
  all[';'] = Class::comment;
  all[','] = Class::comma;
  return all;
}

constexpr std::array<Class, 256> kClasses = classes();

Class class_of(char c) { return kClasses[static_cast<unsigned char>(c)]; }

bool is_word_character(char c) { return class_of(c) == Class::word; }

bool is_letter(char c) { return c >= 'a' && c <= 'z'; }

std::string describe_byte(char c) {
  static constexpr char kHex[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

}  // namespace

Lexer::Lexer(std::span<char> text, DiagnosticLog& log)
    : text_(text),
      log_(log),
      cr_ends_lines_(std::string_view(text.data(), text.size()).find('\n') == std::string_view::npos) {
  if (starts_with("\xff\xfe") || starts_with("\xfe\xff")) {
    log_.error(here(), "the text is UTF-16", "save the file as UTF-8 or ASCII");
    log_.throw_errors();
  }
  if (!starts_with(kByteOrderMark)) return;
  log_.warn(Departure::byte_order_mark, here(), "a byte order mark before the text is passed over",
            "save the file without it");
  line_begin_ = next_ = kByteOrderMark.size();
}

Token Lexer::next() {
  Token token;
  skip_blank();
  token.where = here();
  if (at_end()) return token;
  check_place(token);
  if (class_of(text_[next_]) == Class::parenthesis) {
    token.kind = text_[next_] == '(' ? Token::Kind::open : Token::Kind::close;
    ++next_;
  } else {
    token.kind = Token::Kind::word;
    read_word(token);
  }
  return token;
}

void Lexer::check_place(Token& token) {
  token.first_in_line = line_ != line_of_last_token_;
  if (token.first_in_line) indentation_ = token.where.column;
  line_of_last_token_ = line_;
  token.indentation = indentation_;
}

void Lexer::end_line() {
  ++next_;
  ++line_;
  line_begin_ = next_;
}

void Lexer::skip_blank() {
  while (!at_end()) {
    switch (class_of(text_[next_])) {
      case Class::blank:
        ++next_;
        break;
      case Class::line_feed:
        end_line();
        break;
      case Class::carriage_return:
        if (cr_ends_lines_) {
          end_line();
        } else {
          ++next_;
        }
        break;
      case Class::comment:
        next_ = std::min(rest().find(cr_ends_lines_ ? '\r' : '\n'), length() - next_) + next_;
        break;
      case Class::comma:
        log_.warn(Departure::comma, here(), "a comma is read as a blank",
                  "PDDL separates by blanks: take it away");
        ++next_;
        break;
      case Class::word:
      case Class::parenthesis:
        return;
      case Class::other:
        if (skip_odd_blank()) break;
        if (odd_dash() > 0) return;
        report_bytes();
    }
  }
}

bool Lexer::skip_odd_blank() {
  for (const std::string_view blank : kOddBlanks) {
    if (!starts_with(blank)) continue;
    log_.warn(Departure::odd_character, here(), "a blank beyond ASCII is read as a blank",
              "write plain blanks");
    next_ += blank.size();
    return true;
  }
  return false;
}

std::size_t Lexer::odd_dash() const {
  if (static_cast<unsigned char>(peek()) < 0x80) return 0;
  for (const std::string_view dash : kOddDashes)
    if (starts_with(dash)) return dash.size();
  return 0;
}

// Passes over a run of bytes that no word is made of.
void Lexer::report_bytes() {
  log_.error(here(), describe_byte(peek()) + " outside of a comment", "PDDL names are plain ASCII");
  while (!at_end() && class_of(text_[next_]) == Class::other && odd_dash() == 0) ++next_;
}

void Lexer::read_word(Token& token) {
  if (const std::size_t dash = odd_dash(); dash > 0) {
    log_.warn(Departure::odd_character, here(), "a dash beyond ASCII is read as '-'", "write a plain '-'");
    next_ += dash;
    token.word = "-";
    return;
  }
  const char* const begin = text_.data() + next_;
  if (*begin == '-' && is_letter(begin[1])) {
    log_.warn(Departure::hyphen, here(), "'-' without a blank behind it is read as if there were one",
              "write NAME - TYPE");
    token.word = "-";
    ++next_;
    return;
  }
  const char* end = begin + 1;  // a '?' in front is part of the word
  while (is_word_character(*end) && *end != '?')
    ++end;  // the text ends with a '\0', which is no such character
  const auto size = static_cast<std::size_t>(end - begin);
  token.word = {begin, std::min(size, kMaxWord)};
  next_ += size;  // a word has no end of line in it
  if (class_of(*end) == Class::blank || class_of(*end) == Class::parenthesis) {
    if (size <= kMaxWord && token.word != "?") return;
  }
  if (peek() == '?') {
    log_.warn(Departure::question_mark, here(), "a blank is missing before '?'", "write the blank");
    return;
  }
  if (size > kMaxWord) {
    log_.error(token.where, "a name of more than " + std::to_string(kMaxWord) + " characters",
               "shorten it; it was read up to there");
  }
  if (token.word == "?") join_question_mark(token);
  if (static_cast<unsigned char>(peek()) >= 0x80 && !skip_odd_blank() && odd_dash() == 0) report_bytes();
}

// "? x" is "?x" where the rest of a name follows in the same line.
void Lexer::join_question_mark(Token& token) {
  std::size_t ahead = 0;
  while (peek(ahead) == ' ' || peek(ahead) == '\t') ++ahead;
  if (ahead == 0 || !is_letter(peek(ahead))) return;
  log_.warn(Departure::question_mark, token.where, "a blank behind '?' is passed over",
            "write the name of a variable together with its '?'");
  next_ += ahead;
  char* const begin = text_.data() + next_ - 1;  // the last of the blanks
  *begin = '?';
  std::size_t size = 1;
  while (is_word_character(peek()) && peek() != '?' && size < kMaxWord) {
    ++size;
    ++next_;
  }
  token.word = {begin, size};
}

}  // namespace roci::pddl
