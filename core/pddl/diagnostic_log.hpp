// This file is internal to core/pddl: it collects what is wrong or odd in one text while the reading goes on.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/pddl/source.hpp"

namespace roci::pddl {

/// Keeps the findings of one text within bounds: of findings with the same message a few are kept and the others are
/// counted in the last of these, and reading ends with the kMostErrors-th error.
class DiagnosticLog {
 public:
  static constexpr std::size_t kMostErrors = 1000;
  static constexpr std::size_t kMostAlike = 5;

  DiagnosticLog(std::string file, Strictness strictness) : file_(std::move(file)), strictness_(strictness) {}

  const std::string& file() const { return file_; }

  /// These add a finding at a place of this text. Throws ParseError with all errors so far when there are kMostErrors.
  void error(SourceLocation where, std::string message, std::string remedy);
  void unsupported(SourceLocation where, std::string message, std::string remedy);
  void warn(Departure departure, SourceLocation where, std::string message, std::string remedy);
  void add(Diagnostic diagnostic);

  /// Counts errors and what is not supported; in strict reading departures from PDDL as well.
  std::size_t errors() const { return errors_; }
  bool full() const { return errors_ >= kMostErrors; }

  /// Throws ParseError if there are errors.
  void throw_errors() const;
  /// Returns the warnings in the order of the text.
  std::vector<Diagnostic> warnings() const;

 private:
  std::vector<Diagnostic> told(bool warnings) const;

  struct Alike {
    std::size_t last = 0;  // index of the last one that was kept
    std::size_t count = 0;
  };

  std::string file_;
  Strictness strictness_;
  std::vector<Diagnostic> kept_;
  std::map<std::string, Alike> alike_;
  std::size_t errors_ = 0;
};

}  // namespace roci::pddl
