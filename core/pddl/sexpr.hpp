// This file reads the parenthesised skeleton of PDDL text: lists and words with their places, before any meaning.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Bounds the accepted nesting of parentheses; everything that walks a syntax tree may recurse this deep.
inline constexpr int kMaxNesting = 200;

/// Is a lower-cased word (name, keyword, variable, number, operator) or a list.
struct Sexpr {
  bool is_list = false;
  std::string word;          ///< is set for a word
  std::vector<Sexpr> items;  ///< are set for a list
  SourceLocation where;      ///< first character, a list's "("
  SourceLocation closed;     ///< a list's ")"

  bool is_word(std::string_view text) const { return !is_list && word == text; }
  /// Returns the word in front of a list, as "and" of (and …); it is empty for words and for lists that begin
  /// with a list.
  std::string_view head() const;
};

/// Reads the one list `(define (KIND …) …)`. What else stands in the text is told as a warning and left out; where there is
/// no such list, the first list of the text is returned. What is wrong is told to the log and read on:
/// a parenthesis too few or too many is placed by the keywords of sections, (:action …) and the like, which stand in
/// (define …) alone, and by the indentation, so that the sections behind it are read in their place.
/// Throws ParseError, with all findings so far, for nesting beyond kMaxNesting, or no list at all.
Sexpr read_sexpr(std::string_view text, std::string_view kind, DiagnosticLog& log);

/// Returns the word as a finite decimal number ("5", "-0.5", ".5", "1e3"), if it is one.
std::optional<double> as_number(std::string_view word);

}  // namespace roci::pddl
