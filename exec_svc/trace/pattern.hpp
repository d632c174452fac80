// Patterns are POSIX extended regular expressions over lines of any length (GNU's `\w`, `\s`, `\S`, `\b`
// included).
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

namespace roci::exec::trace {

/// Reports an expression or a replacement that is not valid.
class PatternError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Matches and replaces by a compiled expression.
class Pattern {
 public:
  /// Compiles the expression. Throws PatternError with the reason.
  explicit Pattern(const std::string& expression);

  /// Returns whether it matches somewhere in the text; `^` and `$` are the ends of the text.
  bool found_in(const std::string& text) const;

  /// Throws PatternError when the replacement names a group that the expression has not, or an escape other
  /// than `\0` to `\9` and `\\`.
  void check_replacement(const std::string& replacement) const;

  /// Replaces every match, from left to right; `\1` to `\9` stand for the groups, `\0` for the match.
  std::string replaced(const std::string& text, const std::string& replacement) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace roci::exec::trace
