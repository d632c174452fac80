// This file says where something stands in a text, and how what is wrong or odd there is told.
#pragma once

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace roci::pddl {

/// Holds a line and a column, both from 1, the column in bytes. {0, 0} was made by a program and not read
/// from a text.
struct SourceLocation {
  int line = 0;
  int column = 0;

  auto operator<=>(const SourceLocation&) const = default;
};

/// Says how much a finding weighs.
enum class Severity {
  error,        ///< the text is not what it claims to be
  unsupported,  ///< the text may be right, but says something that no part of this tree takes
  warning       ///< the text departs from PDDL in a way that has one reading, and that reading is taken
};

/// Names each departure from PDDL that is read all the same; docs/pddl-support.md has a row for each.
enum class Departure {
  none,
  byte_order_mark,
  odd_character,
  comma,
  question_mark,
  hyphen,
  outside_text,
  requirement_flag,
  missing_requirement,
  old_section,
  number_type,
  type_twice,
  type_under_itself,
  undeclared_type,
  undeclared_function,
  signature_twice,
  object_twice,
  value_twice,
  hidden_variable,
  missing_goal,
  domain_name
};

/// Returns the word of a departure as it stands in warnings: "missing-goal".
const char* to_string(Departure departure);

/// Says whether departures from PDDL are read with a warning or are errors.
enum class Strictness { tolerant, strict };

/// Tells one thing about an input: where, what, and what to do about it.
struct Diagnostic {
  std::string file;
  SourceLocation where;
  std::string message;
  std::string remedy;
  Severity severity = Severity::error;
  Departure departure = Departure::none;  ///< set for warnings, and in strict reading
};

/// Prints "file:line:column: error: message (remedy)"; a warning ends with its departure, as "[comma]".
std::string to_string(const Diagnostic& diagnostic);

/// Prints one line each, without a newline at the end.
std::string to_text(std::span<const Diagnostic> diagnostics);

/// Reports a text that cannot be taken as what it claims to be. It holds all that is wrong with it, in the order of
/// the text, though at most kMostTold; what() is a line of to_string() for each, and "and N more" if there are.
class ParseError : public std::runtime_error {
 public:
  static constexpr std::size_t kMostTold = 50;

  explicit ParseError(Diagnostic diagnostic);
  /// Takes at least one finding. `untold` counts what was left out of them before.
  explicit ParseError(std::vector<Diagnostic> diagnostics, std::size_t untold = 0);

  /// Returns the first finding of the text.
  const Diagnostic& diagnostic() const { return diagnostics_.front(); }
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  /// Returns how many findings are not among diagnostics().
  std::size_t untold() const { return untold_; }
  /// Returns whether something in the text is not supported, so that it would be refused even with all errors
  /// mended.
  bool unsupported() const;
  const std::string& file() const { return diagnostic().file; }
  int line() const { return diagnostic().where.line; }
  int column() const { return diagnostic().where.column; }

 private:
  std::vector<Diagnostic> diagnostics_;
  std::size_t untold_ = 0;
};

}  // namespace roci::pddl
