// This file is internal to core/pddl: it takes PDDL text apart into parentheses and words.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Bounds the length of a name, in characters.
inline constexpr std::size_t kMaxWord = 1000;

/// Holds one parenthesis, one word, or the end of the text. The word refers to the text of the lexer.
struct Token {
  enum class Kind { open, close, word, end };
  Kind kind = Kind::end;
  bool first_in_line = false;
  int indentation = 0;  ///< the column of the first token of its line
  SourceLocation where;
  std::string_view word;
};

/// Reads tokens from left to right, `;` comments aside. What has one reading is told as a warning: a byte order mark,
/// commas, blanks and dashes beyond ASCII, a blank missing before `?` or standing after it, `-t` for `- t`. Everything
/// else that is no PDDL is told as an error and passed over. Lines end with LF, CR LF, or, in a text without any LF,
/// with CR.
class Lexer {
 public:
  /// Takes a text whose letters are lower-cased, with a '\0' behind its last character. The lexer writes into it where
  /// a '?' is joined with its name. `text` and `log` must outlive the lexer. Throws ParseError for a text in UTF-16, of
  /// which nothing can be read.
  Lexer(std::span<char> text, DiagnosticLog& log);

  Token next();

 private:
  void skip_blank();
  bool skip_odd_blank();
  std::size_t odd_dash() const;
  void read_word(Token& token);
  void join_question_mark(Token& token);
  void report_bytes();
  void check_place(Token& token);

  std::size_t length() const { return text_.size(); }
  bool at_end() const { return next_ >= length(); }
  char peek(std::size_t ahead = 0) const { return next_ + ahead < length() ? text_[next_ + ahead] : '\0'; }
  bool starts_with(std::string_view bytes) const { return rest().starts_with(bytes); }
  std::string_view rest() const { return {text_.data() + next_, length() - next_}; }
  SourceLocation here() const { return {line_, static_cast<int>(next_ - line_begin_) + 1}; }
  void end_line();

  std::span<char> text_;
  DiagnosticLog& log_;
  bool cr_ends_lines_;
  std::size_t next_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  int line_of_last_token_ = 0;
  int indentation_ = 0;
};

}  // namespace roci::pddl
