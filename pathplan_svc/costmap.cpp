#include "pathplan_svc/costmap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace roci::pathplan {
namespace {

bool positive(double v) { return std::isfinite(v) && v > 0; }

double square(double v) { return v * v; }

// Returns how many cells to each side of a cell its plane is fitted to.
int window(double radius, double resolution) {
  return std::max(1, static_cast<int>(std::lround(radius / resolution)));
}

// Holds the least-squares plane through the elevations of a square window around a cell, and the largest
// distance from it.
struct FittedPlane {
  double east;
  double north;
  double residual;
};

FittedPlane fit_plane(const terrain::Site& site, terrain::Cell centre, int half) {
  const terrain::Grid& grid = site.grid();
  const auto elevation = [&](int dx, int dy) {
    return site.elevation(terrain::Cell{std::clamp(centre.column + dx, 0, grid.columns - 1),
                                        std::clamp(centre.row + dy, 0, grid.rows - 1)});
  };
  double mean = 0;
  double east = 0;
  double north = 0;
  double spread = 0;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      const double z = elevation(dx, dy);
      mean += z;
      east += dx * z;
      north += dy * z;
      spread += dx * dx;
    }
  }
  const int side = 2 * half + 1;
  mean /= side * side;
  east /= spread;
  north /= spread;
  double residual = 0;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx) {
      residual = std::max(residual, std::abs(elevation(dx, dy) - mean - east * dx - north * dy));
    }
  }
  return {east / grid.resolution, north / grid.resolution, residual};
}

}  // namespace

const char* to_string(CellState state) {
  switch (state) {
    case CellState::free:
      return "free";
    case CellState::margin:
      return "margin";
    case CellState::steep:
      return "steep";
    case CellState::rough:
      return "rough";
    case CellState::step:
      return "step";
    case CellState::rock:
      return "rock";
    case CellState::unknown:
      return "unknown";
    case CellState::disc:
      return "disc";
    case CellState::keep_out:
      return "keep_out";
  }
  return "invalid";
}

Costmap::Costmap(const terrain::Site& site, const RoverLimits& limits,
                 const std::vector<terrain::Polygon>& keep_out)
    : grid_(site.grid()), limits_(limits) {
  if (!positive(limits.radius) || !positive(limits.max_slope) || !positive(limits.rock_clearance) ||
      !positive(limits.max_roughness) || !(limits.max_step == 0 || positive(limits.max_step))) {
    throw std::invalid_argument(
        "the rover's radius, slope, clearance and roughness limits must be above zero");
  }
  if (limits.radius > kMostRadiusCells * grid_.resolution)
    throw std::invalid_argument("the rover's radius must be 100 cells of the map at most");
  state_.assign(grid_.cell_count(), CellState::free);
  fit_planes(site);
  if (limits.max_step > 0) mark_steps(site);
  mark_rocks(site);
  mark_edge();
  for (const terrain::Polygon& polygon : site.keep_out()) mark_polygon(polygon);
  for (const terrain::Polygon& polygon : keep_out) mark_polygon(polygon);
  mark_unknown(site);
  terrain_state_ = state_;
  if_known_ = terrain_if_known_;
}

void Costmap::fit_planes(const terrain::Site& site) {
  const int half = window(limits_.radius, grid_.resolution);
  const double steepest = square(std::tan(limits_.max_slope));
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    const FittedPlane plane = fit_plane(site, c, half);
    const double residual_share = plane.residual / limits_.max_roughness;
    const double rock_share = site.rock_height(c) / limits_.rock_clearance;
    east_.push_back(static_cast<float>(plane.east));
    north_.push_back(static_cast<float>(plane.north));
    roughness_.push_back(static_cast<float>(std::min(1.0, std::max(residual_share, rock_share))));
    if (square(plane.east) + square(plane.north) > steepest) {
      raise(c, CellState::steep);
    } else if (residual_share > 1) {
      raise(c, CellState::rough);
    }
  }
}

void Costmap::mark_steps(const terrain::Site& site) {
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    for (const terrain::Cell next :
         {terrain::Cell{c.column + 1, c.row}, terrain::Cell{c.column, c.row + 1}}) {
      if (!grid_.contains(next)) continue;
      if (std::abs(site.elevation(next) - site.elevation(c)) <= limits_.max_step) continue;
      raise(c, CellState::step);
      raise(next, CellState::step);
    }
  }
}

void Costmap::mark_rocks(const terrain::Site& site) {
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    const terrain::Occupancy occupancy = site.occupancy(c);
    const bool rock =
        occupancy == terrain::Occupancy::occupied || site.rock_height(c) > limits_.rock_clearance;
    if (!rock) continue;
    raise(c, CellState::rock);
    mark_margin_of(c);
  }
}

void Costmap::mark_unknown(const terrain::Site& site) {
  const std::vector<CellState> known = state_;
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    if (site.occupancy(c) != terrain::Occupancy::unknown || site.rock_height(c) > limits_.rock_clearance) {
      continue;
    }
    raise(c, CellState::unknown);
    mark_margin_of(c);
    ++unknown_cells_;
  }
  if (unknown_cells_ == 0) return;
  // Slope, roughness and steps beside a hole come from made-up ground; they must not prove that there is no way.
  terrain_if_known_ = known;
  const int half = window(limits_.radius, grid_.resolution);
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    if (state_[i] != CellState::unknown) continue;
    const terrain::Cell c = grid_.cell_at(i);
    for (int dy = -half; dy <= half; ++dy) {
      for (int dx = -half; dx <= half; ++dx) {
        const terrain::Cell near{c.column + dx, c.row + dy};
        if (!grid_.contains(near)) continue;
        CellState& state = terrain_if_known_[grid_.index(near)];
        if (state >= CellState::steep && state <= CellState::step) state = CellState::free;
      }
    }
  }
}

void Costmap::mark_margin_of(terrain::Cell blocked) {
  const int reach = static_cast<int>(std::ceil(limits_.radius / grid_.resolution));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double gap_x = std::max(std::abs(dx) - 1, 0) * grid_.resolution;
      const double gap_y = std::max(std::abs(dy) - 1, 0) * grid_.resolution;
      if (square(gap_x) + square(gap_y) < square(limits_.radius)) {
        raise({blocked.column + dx, blocked.row + dy}, CellState::margin);
      }
    }
  }
}

void Costmap::mark_edge() {
  const int width = static_cast<int>(std::ceil(limits_.radius / grid_.resolution));
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    const int inside = std::min({c.column, c.row, grid_.columns - 1 - c.column, grid_.rows - 1 - c.row});
    if (inside < width) raise(c, CellState::margin);
  }
}

void Costmap::raise(terrain::Cell c, CellState state) {
  if (grid_.contains(c)) state_[grid_.index(c)] = std::max(state_[grid_.index(c)], state);
}

bool Costmap::set_discs(const std::vector<Disc>& discs) {
  for (const Disc& disc : discs) {
    if (!std::isfinite(disc.centre.x) || !std::isfinite(disc.centre.y) || !std::isfinite(disc.radius) ||
        disc.radius < 0) {
      throw std::invalid_argument("an obstacle needs a finite centre and a radius of at least zero, metres");
    }
  }
  const std::vector<CellState> before = std::exchange(state_, terrain_state_);
  for (const Disc& disc : discs) mark_disc(disc);
  const std::vector<CellState> before_if_known = if_known_;
  if (unknown_cells_ > 0) {
    // The discs once more, over the ground as it may be.
    std::swap(state_, if_known_);
    state_ = terrain_if_known_;
    for (const Disc& disc : discs) mark_disc(disc);
    std::swap(state_, if_known_);
  }
  // The margin of a disc in unknown ground shows in the second layer alone, and counts for what is proved.
  if (state_ == before && if_known_ == before_if_known) return false;
  changed_.clear();
  for (std::size_t i = 0; i < state_.size(); ++i) {
    if (state_[i] != before[i] || (unknown_cells_ > 0 && if_known_[i] != before_if_known[i]))
      changed_.push_back(i);
  }
  ++version_;
  return true;
}

void Costmap::mark_disc(const Disc& disc) {
  const double reach = disc.radius + limits_.radius;
  const auto clamp_cell = [this](double metres, int cells) {
    return static_cast<int>(std::clamp(metres / grid_.resolution, 0.0, cells - 1.0));
  };
  const double x = disc.centre.x - grid_.origin.x;
  const double y = disc.centre.y - grid_.origin.y;
  for (int row = clamp_cell(y - reach, grid_.rows); row <= clamp_cell(y + reach, grid_.rows); ++row) {
    for (int column = clamp_cell(x - reach, grid_.columns); column <= clamp_cell(x + reach, grid_.columns);
         ++column) {
      const double to_centre_x = std::abs((column + 0.5) * grid_.resolution - x);
      const double to_centre_y = std::abs((row + 0.5) * grid_.resolution - y);
      const double gap_x = std::max(to_centre_x - grid_.resolution / 2, 0.0);
      const double gap_y = std::max(to_centre_y - grid_.resolution / 2, 0.0);
      if (square(to_centre_x) + square(to_centre_y) <= square(disc.radius)) {
        raise({column, row}, CellState::disc);
      } else if (square(gap_x) + square(gap_y) < square(reach)) {
        raise({column, row}, CellState::margin);
      }
    }
  }
}

void Costmap::mark_polygon(const terrain::Polygon& polygon) {
  const auto [west, east] = std::ranges::minmax(polygon.corners, {}, &terrain::Point::x);
  const auto [south, north] = std::ranges::minmax(polygon.corners, {}, &terrain::Point::y);
  // A cell whose centre is farther from the outline than this keeps the rover's radius with each of its points.
  const double reach = limits_.radius + grid_.resolution * std::numbers::sqrt2 / 2;
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    const terrain::Point p = grid_.centre(c);
    if (p.x < west.x - reach || p.x > east.x + reach || p.y < south.y - reach || p.y > north.y + reach) {
      continue;
    }
    if (terrain::contains(polygon, p)) {
      raise(c, CellState::keep_out);
    } else if (terrain::distance_to_outline(polygon, p) < reach) {
      raise(c, CellState::margin);
    }
  }
}

}  // namespace roci::pathplan
