#include "core/pddl/lexer.hpp"

#include <array>

namespace roci::pddl {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

// Blanks and dashes that come along when text is copied from a page or a document, in UTF-8.
constexpr std::array<std::string_view, 6> kOddBlanks = {"\xc2\xa0",     "\xe2\x80\x8b", "\xe2\x80\x89",
                                                        "\xe2\x80\xaf", "\xe3\x80\x80", kByteOrderMark};
constexpr std::array<std::string_view, 4> kOddDashes = {"\xe2\x80\x90", "\xe2\x80\x93", "\xe2\x80\x94",
                                                        "\xe2\x88\x92"};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v'; }

bool is_word_character(char c) {
  return c > ' ' && c < '\x7f' && c != '(' && c != ')' && c != ';' && c != ',';
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string describe_byte(char c) {
  static constexpr char kHex[] = "0123456789abcdef";
  const auto byte = static_cast<unsigned char>(c);
  return std::string("byte 0x") + kHex[byte >> 4] + kHex[byte & 15];
}

}  // namespace

Lexer::Lexer(std::string_view text, DiagnosticLog& log)
    : text_(text), log_(log), cr_ends_lines_(text.find('\n') == std::string_view::npos) {
  if (starts_with("\xff\xfe") || starts_with("\xfe\xff")) {
    log_.error(here_, "the text is UTF-16", "save the file as UTF-8 or ASCII");
    log_.throw_errors();
  }
  if (!starts_with(kByteOrderMark)) return;
  log_.warn(Departure::byte_order_mark, here_, "a byte order mark before the text is passed over",
            "save the file without it");
  next_ += kByteOrderMark.size();
}

Token Lexer::next() {
  Token token;
  skip_blank();
  token.where = here_;
  if (at_end()) return token;
  check_place(token);
  if (peek() == '(' || peek() == ')') {
    token.kind = peek() == '(' ? Token::Kind::open : Token::Kind::close;
    advance();
  } else {
    token.kind = Token::Kind::word;
    read_word(token);
  }
  return token;
}

void Lexer::check_place(Token& token) {
  token.first_in_line = here_.line != line_of_last_token_;
  if (token.first_in_line) indentation_ = here_.column;
  line_of_last_token_ = here_.line;
  token.indentation = indentation_;
}

void Lexer::skip_blank() {
  while (!at_end()) {
    if (peek() == ';') {
      while (!at_end() && !at_line_end()) advance();
    } else if (is_blank(peek())) {
      advance();
    } else if (peek() == ',') {
      log_.warn(Departure::comma, here_, "a comma is read as a blank",
                "PDDL separates by blanks: take it away");
      advance();
    } else if (!skip_odd_blank()) {
      if (is_word_character(peek()) || peek() == '(' || peek() == ')' || !odd_dash().empty()) return;
      report_bytes();
    }
  }
}

bool Lexer::skip_odd_blank() {
  for (const std::string_view blank : kOddBlanks) {
    if (!starts_with(blank)) continue;
    log_.warn(Departure::odd_character, here_, "a blank beyond ASCII is read as a blank",
              "write plain blanks");
    advance(blank.size());
    return true;
  }
  return false;
}

std::string Lexer::odd_dash() const {
  for (const std::string_view dash : kOddDashes)
    if (starts_with(dash)) return std::string(dash);
  return "";
}

// Passes over a run of bytes that no word is made of.
void Lexer::report_bytes() {
  log_.error(here_, describe_byte(peek()) + " outside of a comment", "PDDL names are plain ASCII");
  while (!at_end() && !is_blank(peek()) && !is_word_character(peek()) && peek() != '(' && peek() != ')' &&
         peek() != ';' && peek() != ',' && odd_dash().empty())
    advance();
}

void Lexer::read_word(Token& token) {
  if (const std::string dash = odd_dash(); !dash.empty()) {
    log_.warn(Departure::odd_character, here_, "a dash beyond ASCII is read as '-'", "write a plain '-'");
    advance(dash.size());
    token.word = "-";
    return;
  }
  const bool glued = peek() == '-' && is_letter(peek(1));
  bool too_long = false;
  while (!at_end() && is_word_character(peek())) {
    if (peek() == '?' && !token.word.empty()) {
      log_.warn(Departure::question_mark, here_, "a blank is missing before '?'", "write the blank");
      return;
    }
    if (token.word.size() < kMaxWord) {
      token.word += lower(peek());
    } else {
      too_long = true;
    }
    advance();
    if (glued) {
      log_.warn(Departure::hyphen, token.where, "'-' without a blank behind it is read as if there were one",
                "write NAME - TYPE");
      return;
    }
  }
  if (too_long) {
    log_.error(token.where, "a name of more than " + std::to_string(kMaxWord) + " characters",
               "shorten it; it was read up to there");
  }
  if (token.word == "?") join_question_mark(token);
  if (static_cast<unsigned char>(peek()) >= 0x80 && !skip_odd_blank() && odd_dash().empty()) report_bytes();
}

// "? x" is "?x" where the rest of a name follows in the same line.
void Lexer::join_question_mark(Token& token) {
  std::size_t ahead = 0;
  while (peek(ahead) == ' ' || peek(ahead) == '\t') ++ahead;
  if (ahead == 0 || !is_letter(peek(ahead))) return;
  log_.warn(Departure::question_mark, token.where, "a blank behind '?' is passed over",
            "write the name of a variable together with its '?'");
  advance(ahead);
  while (!at_end() && is_word_character(peek()) && peek() != '?' && token.word.size() < kMaxWord) {
    token.word += lower(peek());
    advance();
  }
}

void Lexer::advance() {
  const bool line_ends = at_line_end();
  ++next_;
  if (line_ends) {
    ++here_.line;
    here_.column = 1;
  } else {
    ++here_.column;
  }
}

void Lexer::advance(std::size_t bytes) {
  for (; bytes > 0; --bytes) advance();
}

}  // namespace roci::pddl
