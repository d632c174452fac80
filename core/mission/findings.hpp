// What is wrong in the files of a mission, one finding per fault: readers that collect note one and go on.
#pragma once

#include <string>
#include <vector>

namespace roci::mission {

enum class Severity {
  error,    ///< the mission cannot be flown as it is meant
  warning,  ///< it can be flown, but something in it can hardly be meant
};

/// Is one fault with its place.
struct Finding {
  std::string file;  ///< as it was named to the reader
  int line = 0;      ///< counts from 1; 0: the file as a whole
  int column = 0;    ///< counts from 1; 0: the line as a whole
  Severity severity = Severity::error;
  std::string what;    ///< in plain words
  std::string remedy;  ///< what to do about it; may be empty

  /// Reads "file:line:column: what", and "file:line:column" where no line is known "file".
  std::string text() const;
  bool operator==(const Finding&) const = default;
};

/// Takes the text of a FileError apart: "file:line:column: what is wrong; remedy".
Finding finding_of(const std::string& text, Severity severity = Severity::error);

/// Holds each finding once, in the order in which they were noted.
class Findings {
 public:
  void add(Finding);
  /// Notes the text of a FileError.
  void add(const std::string& text, Severity severity = Severity::error) { add(finding_of(text, severity)); }
  const std::vector<Finding>& all() const { return all_; }
  std::size_t size() const { return all_.size(); }
  /// Returns them by file, line and column.
  std::vector<Finding> sorted() const;

 private:
  std::vector<Finding> all_;
};

}  // namespace roci::mission
