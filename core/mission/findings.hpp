// Findings say what is wrong in the files of a mission, one per fault; readers that collect them note one and
// go on.
#pragma once

#include <string>
#include <vector>

namespace roci::mission {

/// Says how much a finding weighs.
enum class Severity {
  error,    ///< the mission cannot be flown as it is meant
  warning,  ///< it can be flown, but something in it can hardly be meant
};

/// Describes one fault with its place.
struct Finding {
  std::string file;  ///< as it was named to the reader
  int line = 0;      ///< counts from 1; 0: the file as a whole
  int column = 0;    ///< counts from 1; 0: the line as a whole
  Severity severity = Severity::error;
  std::string what;    ///< in plain words
  std::string remedy;  ///< what to do about it; may be empty

  /// Returns "file:line:column: what", or "file: what" where no line is known.
  std::string text() const;
  bool operator==(const Finding&) const = default;
};

/// Takes the text of a FileError apart: "file:line:column: what is wrong; remedy".
Finding finding_of(const std::string& text, Severity severity = Severity::error);

/// Holds each finding once, in the order in which they were noted.
class Findings {
 public:
  void add(Finding);
  /// Notes the text of a FileError: one finding for each line that begins with a place. Lines "place: error: what
  /// (remedy)" and "place: warning: …", as core/pddl writes them, say their own severity.
  void add(const std::string& text, Severity severity = Severity::error);
  const std::vector<Finding>& all() const { return all_; }
  std::size_t size() const { return all_.size(); }
  /// Returns how many are errors.
  std::size_t errors() const;
  /// Returns them by file, line and column.
  std::vector<Finding> sorted() const;

 private:
  std::vector<Finding> all_;
};

}  // namespace roci::mission
