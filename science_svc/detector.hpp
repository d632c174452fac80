// The detector finds, in images, what nobody asked for: ground that looks unlike what this run has
// shown so far (Background).
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/terrain/site.hpp"
#include "science_svc/background.hpp"
#include "science_svc/camera.hpp"
#include "science_svc/picture.hpp"

namespace roci::science {

/// Says what counts as a find, and how many goals may come of it; lengths are in m.
struct DetectorSettings {
  bool enabled = true;
  double threshold = 0.85;            ///< scores of at least this raise a goal; 0 … 1
  std::string goal_kind = "photo";    ///< is a kind of mission.yaml, with arguments x and y
  double reach_m = 12;                ///< ground farther from the camera shows too little
  temporal::Duration min_interval{};  ///< lies between two goals
  double merge_m = 10;                ///< a place this near to an earlier goal is the same find
  int limit = 5;                      ///< goals in one run
  CameraModel camera;
  std::vector<std::string> warnings{};  ///< of the reader, "place: warning: what (remedy)"
};

/// Holds an image with the place and the direction from which it was taken.
struct Photo {
  std::string id;
  Viewpoint from;
  terrain::GreyImage pixels;
};

/// Describes a place that looks unlike the ground around it.
struct Candidate {
  terrain::Point place;
  double score = 0;  ///< 0 … 1
  Window window;     ///< where the image shows it
};

/// Describes a place that deserves a goal.
struct Find {
  std::string id;  ///< says the place: find-e74n52 lies 74 m east and 52 m north of the map's origin
  terrain::Point place;
  double score = 0;  ///< 0 … 1
  std::string crop;  ///< binary PGM file of what the image shows there
};

/// Returns the id of a find, and the place that the id of one says; nothing if it is none.
std::string find_id(terrain::Point);
std::optional<terrain::Point> place_of(const std::string& find_id);

/// Answers by its settings and by what it has been shown alone.
class Detector {
 public:
  /// Prepares a detector whose goals lie on the site; without one the ground is flat and has no end.
  Detector(DetectorSettings settings, std::shared_ptr<const terrain::Site> site);

  /// Learns from a photo, and returns what scores at least `threshold` in it, the oddest first.
  std::vector<Candidate> candidates(const Photo&, double threshold);
  /// Learns from a photo what ground looks like, each id once, and looks for nothing in it.
  void learn(const Photo&);
  /// Looks at a photo, each id once. Returns what deserves a goal: candidates on the map that no earlier find is near
  /// to, as many as interval and limit allow.
  std::vector<Find> look(const Photo&, temporal::Time now);
  /// Takes in that an earlier process has raised a goal there:
  /// it counts for merging and for the limit, once for each id.
  void remember(const std::string& find_id, temporal::Time now);
  /// Returns whether it has looked at kPhotos (limits.hpp), and looks at no new one.
  bool full() const;

 private:
  bool known(terrain::Point) const;
  bool is_new(const Photo&);
  std::vector<Patch> patches(const Photo&) const;

  DetectorSettings settings_;
  std::shared_ptr<const terrain::Site> site_;
  Background background_;
  std::set<std::string> seen_;
  std::vector<terrain::Point> finds_;
  std::set<std::string> find_ids_;
  std::optional<temporal::Time> last_find_;
};

}  // namespace roci::science
