// The detector finds, in images, what nobody asked for. For now it is a stand-in for a classifier: the score
// of an image is drawn from the seed and the square metre where it was taken, not from its pixels; everything
// after the score is real.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/terrain/grid.hpp"

namespace roci::science {

/// Says what counts as a find, and how many goals may come of it; lengths are in m.
struct DetectorSettings {
  bool enabled = true;
  double threshold = 0.85;            ///< scores of at least this raise a goal; 0 … 1
  std::string goal_kind = "photo";    ///< is a kind of mission.yaml, with arguments x and y
  double offset_m = 12;               ///< lies between where the image was taken and where the goal is
  temporal::Duration min_interval{};  ///< lies between two goals
  double merge_m = 10;                ///< a place this near to an earlier goal is the same find
  int limit = 5;                      ///< goals in one run
};

/// Is an image by the place from which it was taken.
struct Photo {
  std::string id;
  terrain::Point taken_from;
};

/// Is a place that deserves a goal.
struct Find {
  std::string id;
  terrain::Point place;
  double score = 0;  ///< 0 … 1
};

/// Answers by its settings and its seed alone, and remembers what it has found.
class Detector {
 public:
  /// Prepares a detector whose goals lie inside `map`.
  Detector(DetectorSettings settings, terrain::Grid map, std::uint64_t seed);

  /// Returns a score in [0, 1), the same for the same seed and square metre.
  double score(terrain::Point taken_from) const;
  /// Looks at a photo, each once. Returns nothing where it shows nothing new.
  std::optional<Find> look(const Photo&, temporal::Time now);
  /// Whether it has looked at kPhotos (limits.hpp), and looks at no new one.
  bool full() const;

 private:
  std::optional<terrain::Point> place_near(terrain::Point) const;

  DetectorSettings settings_;
  terrain::Grid map_;
  std::uint64_t seed_;
  std::set<std::string> seen_;
  std::vector<Find> finds_;
  temporal::Time last_find_{};
};

}  // namespace roci::science
