// Names that nobody has declared. One slip in a declaration leaves every use of it unknown; so each name is told once,
// with all the places where it stands, and none where a declaration that could not be read may have been it.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/mission/findings.hpp"
#include "planner_svc/utility_htn/reading/source.hpp"

namespace roci::planner::utility_htn::reading {

/// Collects them while a file is read, and tells them in the end.
class UnknownNames {
 public:
  /// Says what is wrong with a name: `what` and `remedy` are told.
  struct Unknown {
    std::string kind;  ///< is the word for it in messages: "timeline"
    std::string name;
    std::string what;
    std::string remedy;
  };
  /// Notes that the name stands here, and throws mission::ToldError.
  [[noreturn]] void fail(Unknown unknown, const Source& source);
  /// The same for a name whose declaration has a fault of its own, which was told there.
  [[noreturn]] void fail_again(const Source& source);
  /// Of this kind some declarations are missing, for faults that were told: no name of it counts as unknown.
  void hide(const std::string& kind) { hidden_.insert(kind); }
  /// Returns how often something failed.
  std::size_t failures() const { return failures_; }

  /// Notes them, `most` at most. No two have the same place: repetitions of an entry have the same fault.
  void report(mission::Findings& findings, std::size_t most) const;

 private:
  struct Occurrences {
    Unknown unknown;
    std::vector<std::string> places;
  };
  std::vector<Occurrences> all_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;  // by kind and name
  std::set<std::string> hidden_;
  std::size_t failures_ = 0;
};

}  // namespace roci::planner::utility_htn::reading
