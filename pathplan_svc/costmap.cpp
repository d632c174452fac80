#include "pathplan_svc/costmap.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace roci::pathplan {
namespace {

bool positive(double v) { return std::isfinite(v) && v > 0; }

double square(double v) { return v * v; }

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
    case CellState::rock:
      return "rock";
    case CellState::unknown:
      return "unknown";
    case CellState::disc:
      return "disc";
  }
  return "invalid";
}

Costmap::Costmap(const terrain::Site& site, const RoverLimits& limits) : grid_(site.grid()), limits_(limits) {
  if (!positive(limits.radius) || !positive(limits.max_slope) || !positive(limits.rock_clearance) ||
      !positive(limits.max_roughness)) {
    throw std::invalid_argument(
        "the rover's radius, slope, clearance and roughness limits must be above zero");
  }
  state_.assign(grid_.cell_count(), CellState::free);
  fit_planes(site);
  mark_rocks(site);
  mark_edge();
  terrain_state_ = state_;
}

void Costmap::fit_planes(const terrain::Site& site) {
  const int half = std::max(1, static_cast<int>(std::lround(limits_.radius / grid_.resolution)));
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

void Costmap::mark_rocks(const terrain::Site& site) {
  for (std::size_t i = 0; i < grid_.cell_count(); ++i) {
    const terrain::Cell c = grid_.cell_at(i);
    const terrain::Occupancy occupancy = site.occupancy(c);
    const bool rock =
        occupancy == terrain::Occupancy::occupied || site.rock_height(c) > limits_.rock_clearance;
    if (!rock && occupancy == terrain::Occupancy::free) continue;
    raise(c, rock ? CellState::rock : CellState::unknown);
    mark_margin_of(c);
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
  if (state_ == before) return false;
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

}  // namespace roci::pathplan
