// The path planner finds paths over the site and what they cost: it answers the service, over cost map,
// searches and table of answers.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "pathplan_svc/answer_table.hpp"
#include "pathplan_svc/corridor_planner.hpp"
#include "pathplan_svc/costmap.hpp"
#include "pathplan_svc/drive_model.hpp"
#include "pathplan_svc/grid_search.hpp"
#include "pathplan_svc/path_outcome.hpp"

namespace roci::pathplan {

/// Bounds the work of a planner and shapes its way-points.
struct PlannerSettings {
  CorridorSettings corridor;
  double waypoint_spacing = 4.0;    ///< m
  double max_piece = 60.0;          ///< Shortcuts try no longer straight piece, m.
  std::size_t max_corners = 60;     ///< Bounds a path before shortcuts.
  std::uint64_t first_version = 1;  ///< that the map has before it changes
};

/// Says what a planner did, for tests and measurements.
struct PlannerWork {
  std::uint64_t searches = 0;  ///< over the whole grid
  std::uint64_t paths = 0;     ///< that were worked out
};

/// Says how much a planner keeps for who asks again.
struct KeptWork {
  std::size_t answers = 0;
  std::size_t trees = 0;  ///< of one search each, a byte for each cell of the map
};

/// Finds fast drives over a map that may gain obstacles. An answer depends on the map and the two ends alone,
/// never on earlier questions. Answers and search trees are kept; when obstacles are added, those stay that would come
/// out the same again, and when a cell becomes free, none. One thread may use it at a time.
///
/// A goal must be free. A start in the margin of an obstacle (one that was seen while the rover stood there)
/// is left by the shortest straight line to a free cell.
class PathPlanner {
 public:
  /// `keep_out` comes on top of the site's own zones.
  PathPlanner(const terrain::Site& site, const RoverLimits& limits, const DriveModel& drive,
              const PlannerSettings& settings = {}, const std::vector<terrain::Polygon>& keep_out = {});

  const Costmap& map() const { return map_; }
  const DriveModel& drive() const { return drive_; }
  const PlannerWork& work() const { return work_; }
  KeptWork kept() const { return {answers_.size(), trees_.size()}; }

  /// Does what Costmap::set_discs does.
  bool set_discs(const std::vector<Disc>& discs);

  /// Lets go of the answers and search trees that nobody has asked for since the last call. Who asks for one later gets
  /// the same answer, worked out anew.
  void forget_unasked();

  PathOutcome path(terrain::Point from, terrain::Point to);
  /// Returns the same without way-points, which is what a table of costs needs.
  PathOutcome cost(terrain::Point from, terrain::Point to);
  /// Returns the same status, and if found a length, time and energy that those of the path are never below: of the
  /// straight line on the best ground of the map, and of the turn at the start. It searches nothing.
  PathOutcome lower_bound(terrain::Point from, terrain::Point to);

 private:
  struct KeptTree {
    SearchTree tree;
    std::uint64_t round;  // in which it was asked for last
  };
  // The ends of a path on the grid; without `start` there is none, and the outcome says why.
  struct Ends {
    PathOutcome outcome;
    std::optional<terrain::Point> start;  // from which the grid is entered
  };

  Ends ends(terrain::Point from, terrain::Point to) const;
  bool may_be_reached(terrain::Cell from, terrain::Cell to) const;
  const KeptAnswer& answer(terrain::Point from, terrain::Point to);
  KeptAnswer plan(terrain::Point from, terrain::Point to);
  // Takes ends that are both free and in one region. The result is never slower than the exact way over the
  // grid, turns included.
  Polyline fastest(terrain::Point from, terrain::Point to, ReadSet& reads);
  // A tree whose way to the target is the best one on the map as it is.
  const SearchTree& tree_between(terrain::Cell source, terrain::Cell target);
  void fill_costs(const Polyline& corners, PathOutcome& outcome) const;

  Costmap map_;
  DriveModel drive_;
  PlannerSettings settings_;
  GridSearch search_;
  Regions regions_;
  std::optional<Regions> hoped_for_;       // where the map knows all ground, there is no need of it
  double least_energy_ = 0;                // J/m, on the ground of the map
  std::map<std::size_t, KeptTree> trees_;  // by their sources
  std::uint64_t round_ = 0;                // rises with each forget_unasked()
  AnswerTable answers_;
  PlannerWork work_;
};

}  // namespace roci::pathplan
