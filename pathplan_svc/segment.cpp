#include "pathplan_svc/segment.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace roci::pathplan {
namespace {

constexpr double kPi = 3.14159265358979323846;

// Is one axis of the walk: the share of the segment at which the next border of a cell is crossed.
struct Axis {
  int step;
  double next;
  double stride;
};

Axis axis(double from, double to, int cell) {
  const double delta = to - from;
  if (delta == 0) return {0, std::numeric_limits<double>::infinity(), 0};
  const double border = delta > 0 ? cell + 1.0 : cell;
  return {delta > 0 ? 1 : -1, (border - from) / delta, std::abs(1 / delta)};
}

// Calls visit(cell, share of the segment inside it) in order until it says false (Amanatides and Woo, "A
// fast voxel traversal algorithm for ray tracing", Eurographics 1987).
template <typename Visit>
void walk(const terrain::Grid& grid, terrain::Point from, terrain::Point to, Visit visit) {
  terrain::Cell cell = grid.cell_of(from);
  const terrain::Cell last = grid.cell_of(to);
  const double scale = 1 / grid.resolution;
  Axis x = axis((from.x - grid.origin.x) * scale, (to.x - grid.origin.x) * scale, cell.column);
  Axis y = axis((from.y - grid.origin.y) * scale, (to.y - grid.origin.y) * scale, cell.row);
  int columns_left = std::abs(last.column - cell.column);
  int rows_left = std::abs(last.row - cell.row);
  double done = 0;
  while (columns_left + rows_left > 0) {
    const bool along_x = rows_left == 0 || (columns_left > 0 && x.next < y.next);
    const double border = std::clamp(along_x ? x.next : y.next, done, 1.0);
    if (!visit(cell, border - done)) return;
    done = border;
    if (along_x) {
      cell.column += x.step;
      x.next += x.stride;
      --columns_left;
    } else {
      cell.row += y.step;
      y.next += y.stride;
      --rows_left;
    }
  }
  visit(cell, 1 - done);
}

}  // namespace

SegmentCost measure(const Costmap& map, const DriveModel& drive, terrain::Point from, terrain::Point to) {
  SegmentCost cost;
  cost.length = terrain::distance(from, to);
  const double unit = cost.length > 0 ? 1 / cost.length : 0;
  const double east = (to.x - from.x) * unit;
  const double north = (to.y - from.y) * unit;
  walk(map.grid(), from, to, [&](terrain::Cell cell, double share) {
    const std::size_t i = map.grid().index(cell);
    const terrain::Gradient g = map.gradient(i);
    const Pace pace = drive.pace(g.east * east + g.north * north, map.roughness(i));
    cost.free = cost.free && map.state(cell) == CellState::free;
    cost.time += pace.time * share * cost.length;
    cost.energy += pace.energy * share * cost.length;
    return true;
  });
  return cost;
}

double drive_time(const Costmap& map, const DriveModel& drive, terrain::Point from, terrain::Point to) {
  const double length = terrain::distance(from, to);
  const double unit = length > 0 ? 1 / length : 0;
  const double east = (to.x - from.x) * unit;
  const double north = (to.y - from.y) * unit;
  double time = 0;
  walk(map.grid(), from, to, [&](terrain::Cell cell, double share) {
    const std::size_t i = map.grid().index(cell);
    const terrain::Gradient g = map.gradient(i);
    time += drive.seconds_per_metre(g.east * east + g.north * north, map.roughness(i)) * share * length;
    return true;
  });
  return time;
}

bool is_free(const Costmap& map, terrain::Point from, terrain::Point to) {
  bool free = true;
  walk(map.grid(), from, to, [&](terrain::Cell cell, double) {
    free = map.state(cell) == CellState::free;
    return free;
  });
  return free;
}

CellState worst_state(const Costmap& map, terrain::Point from, terrain::Point to) {
  CellState worst = CellState::free;
  walk(map.grid(), from, to, [&](terrain::Cell cell, double) {
    worst = std::max(worst, map.state(cell));
    return true;
  });
  return worst;
}

SegmentCost measure(const Costmap& map, const DriveModel& drive, const Polyline& path) {
  SegmentCost total;
  double turned = 0;
  double heading_before = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const SegmentCost leg = measure(map, drive, path[i - 1], path[i]);
    const double heading_now = heading(path[i - 1], path[i]);
    turned += i == 1 ? kFirstTurn : turn_between(heading_before, heading_now);
    heading_before = heading_now;
    total.free = total.free && leg.free;
    total.length += leg.length;
    total.time += leg.time;
    total.energy += leg.energy;
  }
  total.time += drive.turn_time(turned);
  total.energy += drive.turn_energy(turned);
  return total;
}

double heading(terrain::Point from, terrain::Point to) { return std::atan2(to.y - from.y, to.x - from.x); }

double turn_between(double heading_before, double heading_after) {
  const double turn = std::abs(heading_after - heading_before);
  return std::min(turn, 2 * kPi - turn);
}

Polyline densify(const Polyline& path, double spacing) {
  Polyline dense;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (i > 0) {
      const terrain::Point a = path[i - 1];
      const terrain::Point b = path[i];
      const int parts = static_cast<int>(std::ceil(terrain::distance(a, b) / spacing));
      for (int k = 1; k < parts; ++k) {
        const double share = static_cast<double>(k) / parts;
        dense.push_back({a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share});
      }
    }
    dense.push_back(path[i]);
  }
  return dense;
}

}  // namespace roci::pathplan
