// This file is internal to core/pddl: it reads one line of a line-oriented file (plans, tables of function
// values) from left to right.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Takes a line apart. Everything that expects something throws ParseError, with the place, where it is
/// missing.
class LineScanner {
 public:
  /// Takes `text` without its newline; a comment begins at a ';'.
  LineScanner(std::string_view text, std::string_view file, int line);

  /// These skip blanks, then look or take.
  bool at_end();
  bool take(char c);
  void expect(char c, std::string_view remedy);
  void expect_end(std::string_view remedy);
  /// Takes what stands before the next blank, parenthesis, bracket or colon, lower-cased; it may be empty.
  std::string take_word();
  double expect_number(std::string_view what);
  /// Takes `(name object …)` without variables. Throws ParseError for anything else.
  Atom expect_ground_atom(std::string_view what);

  SourceLocation here() const { return {line_, static_cast<int>(next_) + 1}; }
  [[noreturn]] void fail(SourceLocation where, std::string message, std::string_view remedy) const;

 private:
  void skip_blank();

  std::string_view text_;
  std::string_view file_;
  int line_;
  std::size_t next_ = 0;
};

/// Calls read(scanner) for each line that holds more than blanks and comment.
void for_each_line(std::string_view text, std::string_view file,
                   const std::function<void(LineScanner&)>& read);

}  // namespace roci::pddl
