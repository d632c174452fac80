// Unknown names are those that nobody has declared. One slip in a declaration leaves every use of it unknown; so each
// name is reported once, with all its places, and not at all where a declaration that could not be read may have been
// its own.
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

/// Collects unknown names while a file is read, and reports them in the end.
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
  /// Does the same for a name whose declaration has a fault of its own, which was reported there.
  [[noreturn]] void fail_again(const Source& source);
  /// Lets no name of this kind count as unknown, since some declarations are missing for faults that were
  /// reported.
  void hide(const std::string& kind) { hidden_.insert(kind); }
  /// Returns how often something failed.
  std::size_t failures() const { return failures_; }

  /// Notes the names, at most `most` of them. No two have the same place, since repetitions of an entry have
  /// the same fault.
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
