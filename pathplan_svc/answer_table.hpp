// The answer table keeps paths that were found, for who asks again, as long as the map beneath them stands.
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "pathplan_svc/path_outcome.hpp"
#include "pathplan_svc/read_set.hpp"

namespace roci::pathplan {

/// Holds an answer with what it rests on.
struct KeptAnswer {
  PathOutcome outcome;      ///< without way-points
  Polyline corners;         ///< of the path, if found
  ReadSet reads;            ///< Holds the cells that it was worked out from.
  std::uint64_t round = 0;  ///< is the table's in which it was asked for last.
};

/// Keeps answers by their two ends, for one version of the map after the other.
class AnswerTable {
 public:
  /// Returns null if there is none. It stays where it is until the next put(), keep_unread() or clear().
  const KeptAnswer* find(terrain::Point from, terrain::Point to);
  /// Keeps an answer; a full table is emptied first.
  const KeptAnswer& put(terrain::Point from, terrain::Point to, KeptAnswer answer);

  /// Lets go of what obstacles that were added to the map may have changed: paths that were worked out from a
  /// cell in `changed`, and all answers that are no path.
  void keep_unread(const ReadSet& changed);
  void clear() { answers_.clear(); }
  /// Lets go of the answers that were neither put in nor found since the last call.
  void forget_unasked();

  std::size_t size() const { return answers_.size(); }

  /// Bounds its memory to about 90 MB; it is a table of 400 places.
  static constexpr std::size_t kMost = 160'000;

 private:
  using Key = std::pair<std::pair<double, double>, std::pair<double, double>>;
  std::map<Key, KeptAnswer> answers_;
  std::uint64_t round_ = 0;  // rises with each forget_unasked()
};

}  // namespace roci::pathplan
