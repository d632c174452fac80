// One entry of a network file can stand for many: `for: {site: [0, 1, 2], target: targets}` repeats it for each
// combination.
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/mission/findings.hpp"
#include "planner_svc/utility_htn/reading/source.hpp"
#include "planner_svc/utility_htn/reading/unknown_names.hpp"

namespace roci::planner::utility_htn::reading {

/// Holds the named lists of a file (`sets`).
using Sets = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Ends the reading of a file in which no more faults are looked for: those that end it are noted already.
class ReadingAborted : public std::exception {};

/// Repeats entries, at most so many in one file that memory is safe.
class Expansion {
 public:
  /// Bounds the faults of a file that are noted.
  static constexpr std::size_t kMostFindings = 100;

  /// Notes faults in `findings`, and names of missing sets in `unknown`. Both must outlive this object.
  Expansion(Sets sets, mission::Findings& findings, UnknownNames& unknown)
      : sets_(std::move(sets)), findings_(&findings), unknown_(&unknown) {}

  using Read = std::function<void(const std::string& key, const Source& value)>;
  /// Reads each field of a mapping, repeated as its `for` says. Faults of one repetition end the others of that field:
  /// they would be the same.
  void each_field(const Source& mapping, const Read& read);
  /// Reads each item of a list likewise.
  void each_item(const Source& list, const std::function<void(const Source&)>& read);
  /// Returns the values that "[0, 1, 2]", "{from: 1, to: 22}" or the name of a set stand for.
  std::vector<std::string> values(const Source& source);
  /// Counts items of lists that are read, as often as they are: aliases of YAML may stand for many.
  /// Throws ReadingAborted beyond the bounds.
  void spend(const Source& list, std::size_t items);
  /// Throws ReadingAborted where so many faults are noted that nobody reads more.
  void stop_at_many_findings() const;

 private:
  [[noreturn]] void stop(const Source& at, const std::string& what);
  std::vector<Bindings> combinations(const Source& repeated);
  void repeat(const Source& value, const std::function<void(const Source&)>& read);

  Sets sets_;
  mission::Findings* findings_;
  UnknownNames* unknown_;
  std::size_t repetitions_ = 0;
  std::size_t items_ = 0;
};

}  // namespace roci::planner::utility_htn::reading
