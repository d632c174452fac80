#include "pathplan_svc/path_planner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/bytes/fnv_1a.hpp"
#include "pathplan_svc/shortcut.hpp"

namespace roci::pathplan {
namespace {

constexpr std::size_t kTreeBytes = 64'000'000;  // a tree has a byte for each cell
constexpr double kRounding = 1e-9;              // by which a sum of pieces may fall below the whole

// Returns a seed from the coordinates of the ends.
std::uint64_t seed_of(terrain::Point from, terrain::Point to) {
  bytes::Fnv1a hash;
  for (const double coordinate : {from.x, from.y, to.x, to.y})
    hash.add_number(std::bit_cast<std::uint64_t>(coordinate));
  return hash.value();
}

// Returns how many cells around a start may be the first on the way out of a margin.
int exit_reach(const Costmap& map) {
  return static_cast<int>(map.limits().radius / map.grid().resolution) + 2;
}

// Returns the nearest centre of a free cell that a straight line through margin reaches, or the point itself
// where it is free.
std::optional<terrain::Point> leave_margin(const Costmap& map, terrain::Point from) {
  if (map.is_free(from)) return from;
  const terrain::Grid& grid = map.grid();
  const terrain::Cell here = grid.cell_of(from);
  if (map.state(here) != CellState::margin) return std::nullopt;
  const int reach = exit_reach(map);
  std::optional<terrain::Point> best;
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const terrain::Cell c{here.column + dx, here.row + dy};
      if (!map.is_free(c)) continue;
      const terrain::Point centre = grid.centre(c);
      const bool nearer = !best || terrain::distance(from, centre) < terrain::distance(from, *best);
      if (nearer && worst_state(map, from, centre) <= CellState::margin) best = centre;
    }
  }
  return best;
}

}  // namespace

const char* to_string(PathStatus status) {
  switch (status) {
    case PathStatus::found:
      return "found";
    case PathStatus::unreachable:
      return "unreachable";
    case PathStatus::unknown:
      return "unknown";
    case PathStatus::start_outside:
      return "start_outside";
    case PathStatus::goal_outside:
      return "goal_outside";
    case PathStatus::start_blocked:
      return "start_blocked";
    case PathStatus::goal_blocked:
      return "goal_blocked";
  }
  return "invalid";
}

PathPlanner::PathPlanner(const terrain::Site& site, const RoverLimits& limits, const DriveModel& drive,
                         const PlannerSettings& settings, const std::vector<terrain::Polygon>& keep_out)
    : map_(site, limits, keep_out),
      drive_(drive),
      settings_(settings),
      search_(map_, drive_),
      regions_(map_) {
  map_.count_versions_from(settings_.first_version);
  if (map_.unknown_cells() > 0) hoped_for_.emplace(map_, Regions::Ground::hoped_for);
  // A path leads over free ground, and out of margin.
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < map_.grid().cell_count(); ++i) {
    if (map_.state(i) > CellState::margin) continue;
    const terrain::Gradient g = map_.gradient(i);
    least = std::min(least, drive_.least_energy(std::hypot(g.east, g.north), map_.roughness(i)));
  }
  if (std::isfinite(least)) least_energy_ = least;
}

bool PathPlanner::set_discs(const std::vector<Disc>& discs) {
  if (!map_.set_discs(discs)) return false;
  regions_ = Regions(map_);
  if (hoped_for_) hoped_for_.emplace(map_, Regions::Ground::hoped_for);
  ReadSet changed(map_.grid());
  bool cleared = false;
  for (const std::size_t i : map_.changed_cells()) {
    changed.add(map_.grid().cell_at(i));
    cleared = cleared || map_.state(i) == CellState::free;
  }
  if (cleared) {
    trees_.clear();
    answers_.clear();
  } else {
    answers_.keep_unread(changed);
  }
  return true;
}

void PathPlanner::forget_unasked() {
  answers_.forget_unasked();
  std::erase_if(trees_, [this](const auto& entry) { return entry.second.round < round_; });
  ++round_;
}

PathOutcome PathPlanner::path(terrain::Point from, terrain::Point to) {
  const KeptAnswer& known = answer(from, to);
  PathOutcome outcome = known.outcome;
  outcome.waypoints = densify(known.corners, settings_.waypoint_spacing);
  return outcome;
}

PathOutcome PathPlanner::cost(terrain::Point from, terrain::Point to) { return answer(from, to).outcome; }

PathOutcome PathPlanner::lower_bound(terrain::Point from, terrain::Point to) {
  PathOutcome outcome = ends(from, to).outcome;
  if (outcome.status != PathStatus::found || from == to) return outcome;
  outcome.length = terrain::distance(from, to) * (1 - kRounding);
  outcome.time = (outcome.length * drive_.fastest() + drive_.turn_time(kFirstTurn)) * (1 - kRounding);
  outcome.energy = (outcome.length * least_energy_ + drive_.turn_energy(kFirstTurn)) * (1 - kRounding);
  return outcome;
}

const KeptAnswer& PathPlanner::answer(terrain::Point from, terrain::Point to) {
  if (const KeptAnswer* known = answers_.find(from, to)) return *known;
  return answers_.put(from, to, plan(from, to));
}

PathPlanner::Ends PathPlanner::ends(terrain::Point from, terrain::Point to) const {
  Ends ends;
  const auto refuse = [&](PathStatus status, CellState blocked_by = CellState::free) {
    ends.outcome.status = status;
    ends.outcome.blocked_by = blocked_by;
    ends.start.reset();
    return ends;
  };
  const terrain::Grid& grid = map_.grid();
  if (!grid.contains(from)) return refuse(PathStatus::start_outside);
  if (!grid.contains(to)) return refuse(PathStatus::goal_outside);
  const terrain::Cell here = grid.cell_of(from);
  const terrain::Cell there = grid.cell_of(to);
  const auto not_found = [&](PathStatus status, CellState blocked_by = CellState::free) {
    return refuse(may_be_reached(here, there) ? PathStatus::unknown : status, blocked_by);
  };
  ends.start = leave_margin(map_, from);
  if (!ends.start) return not_found(PathStatus::start_blocked, map_.state(here));
  if (from == to) return ends;
  if (!map_.is_free(to)) return not_found(PathStatus::goal_blocked, map_.state(there));
  const std::size_t source = grid.index(grid.cell_of(*ends.start));
  if (regions_.region(source) != regions_.region(grid.index(there))) {
    return not_found(PathStatus::unreachable);
  }
  return ends;
}

// Errs on the side of hope: what it denies is denied by known ground.
bool PathPlanner::may_be_reached(terrain::Cell from, terrain::Cell to) const {
  if (!hoped_for_) return false;
  const terrain::Grid& grid = map_.grid();
  const std::uint32_t wanted = hoped_for_->region(grid.index(to));
  if (wanted == 0) return false;
  const int reach = exit_reach(map_);
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const terrain::Cell c{from.column + dx, from.row + dy};
      if (grid.contains(c) && hoped_for_->region(grid.index(c)) == wanted) return true;
    }
  }
  return false;
}

const SearchTree& PathPlanner::tree_between(terrain::Cell source, terrain::Cell target) {
  const std::size_t index = map_.grid().index(source);
  const auto known = trees_.find(index);
  if (known != trees_.end() && known->second.tree.holds(map_, target)) {
    known->second.round = round_;
    return known->second.tree;
  }
  if (trees_.size() * map_.grid().cell_count() >= kTreeBytes) trees_.clear();
  ++work_.searches;
  return trees_.insert_or_assign(index, KeptTree{search_.from(map_, source), round_}).first->second.tree;
}

KeptAnswer PathPlanner::plan(terrain::Point from, terrain::Point to) {
  KeptAnswer answer;
  answer.reads = ReadSet(map_.grid());
  std::optional<terrain::Point> start;
  {
    const Costmap::Recording recording(map_, answer.reads);
    Ends found = ends(from, to);
    answer.outcome = std::move(found.outcome);
    start = found.start;
  }
  if (!start) return answer;
  ++work_.paths;
  Polyline& corners = answer.corners;
  if (from == to) {
    corners = {from};
  } else {
    corners = *start == to ? Polyline{to} : fastest(*start, to, answer.reads);
    if (*start != from) corners.insert(corners.begin(), from);
  }
  fill_costs(corners, answer.outcome);
  return answer;
}

Polyline PathPlanner::fastest(terrain::Point from, terrain::Point to, ReadSet& reads) {
  const auto straighten = [&](const Polyline& path) {
    return shortcut(map_, drive_, thin(map_, path, settings_.max_corners), settings_.max_piece);
  };
  const auto time = [&](const Polyline& path) { return measure(map_, drive_, path).time; };

  const terrain::Cell target = map_.grid().cell_of(to);
  const SearchTree& tree = tree_between(map_.grid().cell_of(from), target);
  const Costmap::Recording recording(map_, reads);
  tree.holds(map_, target);  // The way stands on the cells that this looks at.
  Polyline exact = tree.path_to(target);
  if (exact.size() == 1) return {from, to};
  exact.front() = from;
  exact.back() = to;
  Polyline best = straighten(exact);
  if (time(exact) < time(best)) best = exact;
  if (const auto sampled = plan_in_corridor(map_, drive_, best, settings_.corridor, seed_of(from, to))) {
    const Polyline candidate = straighten(*sampled);
    if (time(candidate) < time(best)) best = candidate;
  }
  return best;
}

void PathPlanner::fill_costs(const Polyline& corners, PathOutcome& outcome) const {
  const SegmentCost cost = measure(map_, drive_, corners);
  outcome.length = cost.length;
  outcome.time = cost.time;
  outcome.energy = cost.energy;
}

}  // namespace roci::pathplan
