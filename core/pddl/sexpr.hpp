// This file reads the parenthesised skeleton of PDDL text: lists and words with their places, before any meaning.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/pddl/diagnostic_log.hpp"

namespace roci::pddl {

/// Bounds the accepted nesting of parentheses; everything that walks a syntax tree may recurse this deep.
inline constexpr int kMaxNesting = 200;

/// Refers to a lower-cased word (name, keyword, variable, number, operator) or a list that its SexprTree
/// owns. It is as cheap to copy as a view.
class Sexpr {
 public:
  static Sexpr word_at(std::string_view word, SourceLocation where) {
    return Sexpr(word.data(), word.size(), false, where, where);
  }
  static Sexpr list_at(std::span<const Sexpr> items, SourceLocation where, SourceLocation closed) {
    return Sexpr(items.data(), items.size(), true, where, closed);
  }

  bool is_list() const { return is_list_; }
  /// Returns the text of a word, which has at least one character; it is empty for a list.
  std::string_view word() const {
    return is_list_ ? std::string_view() : std::string_view(static_cast<const char*>(parts_), count_);
  }
  /// Returns the parts of a list; there are none in a word.
  std::span<const Sexpr> items() const {
    return is_list_ ? std::span<const Sexpr>(static_cast<const Sexpr*>(parts_), count_)
                    : std::span<const Sexpr>();
  }
  bool is_word(std::string_view text) const { return !is_list_ && word() == text; }
  /// Returns the word in front of a list, as "and" of (and …); it is empty for words and for lists that begin
  /// with a list.
  std::string_view head() const { return items().empty() ? std::string_view() : items().front().word(); }

  SourceLocation where;   ///< first character, a list's "("
  SourceLocation closed;  ///< a list's ")"

 private:
  Sexpr(const void* parts, std::size_t count, bool is_list, SourceLocation from, SourceLocation to)
      : where(from), closed(to), parts_(parts), count_(count), is_list_(is_list) {}

  const void* parts_;  // characters of a word, parts of a list
  std::size_t count_ : 63;
  bool is_list_ : 1;
};

/// Owns the text and the lists that the Sexprs of one text refer to, packed into a few blocks. What root() returns
/// stays valid when the tree is moved, and as long as it lives.
class SexprTree {
 public:
  /// Keeps a copy of the text with its letters lower-cased.
  explicit SexprTree(std::string_view text);

  const Sexpr& root() const { return *root_; }
  /// Returns the text, with a '\0' behind its last character.
  std::span<char> text() { return std::span(text_).first(text_.size() - 1); }

  /// Copies the parts of a list to where they stay.
  std::span<const Sexpr> keep(std::span<const Sexpr> items);
  void set_root(const Sexpr& root) { root_ = root; }

 private:
  std::vector<char> text_;
  std::vector<std::vector<Sexpr>> blocks_;  // none of them ever grows beyond what it has reserved
  std::optional<Sexpr> root_;
};

/// Reads the one list `(define (KIND …) …)`. What else stands in the text is told as a warning and left out; where
/// there is no such list, the first list of the text is returned. What is wrong is told to the log and read on:
/// a parenthesis too few or too many is placed by the keywords of sections, (:action …) and the like, which stand in
/// (define …) alone, and by the indentation, so that the sections behind it are read in their place.
/// Throws ParseError, with all findings so far, for nesting beyond kMaxNesting, or no list at all.
SexprTree read_sexpr(std::string_view text, std::string_view kind, DiagnosticLog& log);

/// Returns the word as a finite decimal number ("5", "-0.5", ".5", "1e3"), if it is one.
std::optional<double> as_number(std::string_view word);

}  // namespace roci::pddl
