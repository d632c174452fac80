// This file is internal to core/pddl: it takes PDDL text apart into parentheses and words.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Bounds the length of a name, in characters.
inline constexpr std::size_t kMaxWord = 1000;

/// Is one parenthesis, one lower-cased word, or the end of the text.
struct Token {
  enum class Kind { open, close, word, end };
  Kind kind = Kind::end;
  std::string word;
  SourceLocation where;
  bool first_in_line = false;
  int indentation = 0;  ///< the column of the first token of its line
};

/// Reads tokens from left to right, `;` comments aside. What has one reading is told as a warning: a byte order mark,
/// commas, blanks and dashes beyond ASCII, a blank missing before `?` or standing after it, `-t` for `- t`. Everything
/// else that is no PDDL is told as an error and passed over. Lines end with LF, CR LF, or, in a text without any LF,
/// with CR. `text` and `log` must outlive the lexer.
class Lexer {
 public:
  /// Throws ParseError for a text in UTF-16, of which nothing can be read.
  Lexer(std::string_view text, DiagnosticLog& log);

  Token next();

 private:
  void skip_blank();
  bool skip_odd_blank();
  std::string odd_dash() const;
  void read_word(Token& token);
  void join_question_mark(Token& token);
  void report_bytes();
  void check_place(Token& token);

  bool at_end() const { return next_ >= text_.size(); }
  char peek(std::size_t ahead = 0) const {
    return next_ + ahead < text_.size() ? text_[next_ + ahead] : '\0';
  }
  bool starts_with(std::string_view bytes) const { return text_.substr(next_).starts_with(bytes); }
  bool at_line_end() const { return peek() == '\n' || (cr_ends_lines_ && peek() == '\r'); }
  void advance();
  void advance(std::size_t bytes);

  std::string_view text_;
  DiagnosticLog& log_;
  bool cr_ends_lines_;
  std::size_t next_ = 0;
  SourceLocation here_{1, 1};
  int line_of_last_token_ = 0;
  int indentation_ = 0;
};

}  // namespace roci::pddl
