// A trace map is one committed renaming between two versions of the code: it says what the lines of OLD are
// called in NEW, what NEW has in addition, and which differences remain, each with its reason. The README
// publishes the file's schema.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "exec_svc/trace/pattern.hpp"

namespace roci::exec::trace {

/// Numbers the newest version of the file that this code reads.
inline constexpr int kMapFormat = 1;

/// Says where a rule stands ("file:line:column"), by which reports and counts name it.
using Place = std::string;

/// Holds the new name of a word.
struct NewName {
  std::string to;
  Place place;
};
using NewNames = std::map<std::string, NewName, std::less<>>;

/// Rewrites OLD lines of one kind, or of any kind if none is named.
struct Rewrite {
  std::optional<std::string> kind;
  Pattern pattern;
  std::string replacement;
  Place place;
};

/// Says what is taken out of NEW lines before they are compared: whole lines, or what a pattern matches in
/// them.
struct Addition {
  std::optional<std::string> kind;
  Pattern pattern;
  bool whole_line = false;
  std::string shown;
  Place place;
};

/// Names kinds of lines that may stand in another order within one mission time.
struct FreeOrder {
  std::vector<std::string> kinds;
  std::string reason;
  Place place;
};

/// Describes a difference that remains. With `before` alone it is a line that only OLD has, with `after`
/// alone one that only NEW has, with both a line that stands for the other one at the same mission time.
/// Patterns see OLD lines with their new names. Lines before the mission time `since` are not accepted.
struct Accepted {
  Pattern scenario;
  temporal::Time since{0};
  std::optional<Pattern> before;
  std::optional<Pattern> after;
  std::string reason;
  Place place;
};

/// Holds the rules of one map file, in the order of the file.
struct TraceMap {
  NewNames names;  ///< rename words that are neither the kind of a line nor the name of a field
  NewNames kinds;  ///< rename the first words of lines
  NewNames keys;   ///< rename words before an equals sign
  std::vector<Rewrite> rewrites;
  std::vector<Addition> additions;
  std::vector<FreeOrder> free_orders;
  std::vector<Accepted> accepted;
};

/// Reads the file. Throws mission::FileError with file, line, column and remedy.
TraceMap read_map(const std::filesystem::path& file);

}  // namespace roci::exec::trace
