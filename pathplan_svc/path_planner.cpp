#include "pathplan_svc/path_planner.hpp"

#include <array>
#include <cstring>
#include <optional>

#include "pathplan_svc/shortcut.hpp"

namespace roci::pathplan {
namespace {

constexpr std::size_t kMaxTrees = 256;
constexpr std::size_t kMaxAnswers = 16384;

// Returns a seed from the coordinates of the ends (FNV-1a over their bytes).
std::uint64_t seed_of(terrain::Point from, terrain::Point to) {
  const std::array<double, 4> ends{from.x, from.y, to.x, to.y};
  std::array<unsigned char, sizeof ends> bytes;
  std::memcpy(bytes.data(), ends.data(), sizeof ends);
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3ULL;
  return hash;
}

PathOutcome refusal(PathStatus status, CellState blocked_by = CellState::free) {
  PathOutcome outcome;
  outcome.status = status;
  outcome.blocked_by = blocked_by;
  return outcome;
}

// Returns the nearest centre of a free cell that a straight line through margin reaches, or the point itself
// where it is free.
std::optional<terrain::Point> leave_margin(const Costmap& map, terrain::Point from) {
  if (map.is_free(from)) return from;
  const terrain::Grid& grid = map.grid();
  const terrain::Cell here = grid.cell_of(from);
  if (map.state(here) != CellState::margin) return std::nullopt;
  const int reach = static_cast<int>(map.limits().radius / grid.resolution) + 2;
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
                         const PlannerSettings& settings)
    : map_(site, limits), drive_(drive), settings_(settings), search_(map_, drive_), regions_(map_) {}

bool PathPlanner::set_discs(const std::vector<Disc>& discs) {
  if (!map_.set_discs(discs)) return false;
  regions_ = Regions(map_);
  trees_.clear();
  answers_.clear();
  return true;
}

PathOutcome PathPlanner::path(terrain::Point from, terrain::Point to) {
  if (!map_.grid().contains(from)) return refusal(PathStatus::start_outside);
  if (!map_.grid().contains(to)) return refusal(PathStatus::goal_outside);
  const auto key = std::pair{std::pair{from.x, from.y}, std::pair{to.x, to.y}};
  const auto known = answers_.find(key);
  if (known != answers_.end()) return known->second;
  if (answers_.size() >= kMaxAnswers) answers_.clear();
  return answers_.emplace(key, plan(from, to)).first->second;
}

const SearchTree& PathPlanner::tree_from(terrain::Cell source) {
  const std::size_t index = map_.grid().index(source);
  const auto known = trees_.find(index);
  if (known != trees_.end()) return known->second;
  if (trees_.size() >= kMaxTrees) trees_.clear();
  return trees_.emplace(index, search_.from(map_, source)).first->second;
}

PathOutcome PathPlanner::plan(terrain::Point from, terrain::Point to) {
  const terrain::Grid& grid = map_.grid();
  const std::optional<terrain::Point> start = leave_margin(map_, from);
  if (!start) return refusal(PathStatus::start_blocked, map_.state(grid.cell_of(from)));
  if (from == to) return finish({from});
  if (!map_.is_free(to)) return refusal(PathStatus::goal_blocked, map_.state(grid.cell_of(to)));
  const terrain::Cell source = grid.cell_of(*start);
  const terrain::Cell target = grid.cell_of(to);
  if (regions_.region(grid.index(source)) != regions_.region(grid.index(target))) {
    return refusal(PathStatus::unreachable);
  }

  Polyline corners = *start == to ? Polyline{to} : fastest(*start, to);
  if (*start != from) corners.insert(corners.begin(), from);
  return finish(corners);
}

Polyline PathPlanner::fastest(terrain::Point from, terrain::Point to) {
  const auto straighten = [&](const Polyline& path) {
    return shortcut(map_, drive_, thin(map_, path, settings_.max_corners), settings_.max_piece);
  };
  const auto time = [&](const Polyline& path) { return measure(map_, drive_, path).time; };

  Polyline exact = tree_from(map_.grid().cell_of(from)).path_to(map_.grid().cell_of(to));
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

PathOutcome PathPlanner::finish(const Polyline& corners) const {
  const SegmentCost cost = measure(map_, drive_, corners);
  PathOutcome outcome;
  outcome.waypoints = densify(corners, settings_.waypoint_spacing);
  outcome.length = cost.length;
  outcome.time = cost.time;
  outcome.energy = cost.energy;
  return outcome;
}

}  // namespace roci::pathplan
