// This file says where something stands in a text, and how an error there is told.
#pragma once

#include <stdexcept>
#include <string>

namespace roci::pddl {

/// Holds a line and a column, both from 1, the column in bytes. {0, 0} was made by a program and not read
/// from a text.
struct SourceLocation {
  int line = 0;
  int column = 0;

  auto operator<=>(const SourceLocation&) const = default;
};

/// Tells one thing wrong with an input: where, what, and what to do about it.
struct Diagnostic {
  std::string file;
  SourceLocation where;
  std::string message;
  std::string remedy;
};

/// Prints "file:line:column: error: message (remedy)".
std::string to_string(const Diagnostic& diagnostic);

/// Is thrown for any text that cannot be taken as what it claims to be; what() is to_string(diagnostic()).
class ParseError : public std::runtime_error {
 public:
  explicit ParseError(Diagnostic diagnostic);

  const Diagnostic& diagnostic() const { return diagnostic_; }
  const std::string& file() const { return diagnostic_.file; }
  int line() const { return diagnostic_.where.line; }
  int column() const { return diagnostic_.where.column; }

 private:
  Diagnostic diagnostic_;
};

}  // namespace roci::pddl
