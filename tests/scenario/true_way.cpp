#include "tests/scenario/true_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "sim_svc/components/standard_types.hpp"
#include "sim_svc/scenario/run_file.hpp"

namespace roci::scenario {
namespace {

double slope_at(const sim::world::Ground& ground, terrain::Point p) {
  const terrain::Gradient gradient = ground.site->gradient(p);
  return std::atan(std::hypot(gradient.east, gradient.north));
}

std::vector<bool> free_cells(const sim::world::Ground& ground, const TrueLimits& limits) {
  const terrain::Grid& grid = ground.site->grid();
  std::vector<terrain::Point> rocks;
  for (std::size_t i = 0; i < grid.cell_count(); ++i)
    if (ground.site->rock_height(grid.cell_at(i)) > limits.rock_clearance_m)
      rocks.push_back(grid.centre(grid.cell_at(i)));
  const double reach = limits.radius_m + grid.resolution / 2;
  std::vector<bool> out(grid.cell_count());
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    const terrain::Point p = grid.centre(grid.cell_at(i));
    const bool inside = p.x - grid.origin.x >= limits.radius_m && p.y - grid.origin.y >= limits.radius_m &&
                        grid.origin.x + grid.width() - p.x >= limits.radius_m &&
                        grid.origin.y + grid.height() - p.y >= limits.radius_m;
    out[i] =
        inside && slope_at(ground, p) <= limits.max_slope_deg * std::numbers::pi / 180 &&
        !no_go_at(ground, limits.vehicle, p) &&
        std::ranges::none_of(rocks, [&](terrain::Point rock) { return terrain::distance(rock, p) < reach; });
  }
  for (const sim::world::Rock& rock : ground.hidden_rocks)
    for (std::size_t i = 0; i < grid.cell_count(); ++i)
      if (terrain::distance({rock.x, rock.y}, grid.centre(grid.cell_at(i))) < rock.radius + limits.radius_m)
        out[i] = false;
  return out;
}

}  // namespace

sim::world::Ground true_ground(const std::string& mission, const std::string& scenario, std::uint64_t seed) {
  sim::world::Ground ground =
      sim::scenario::load_run(mission, scenario, sim::components::standard_types()).world.ground;
  sim::world::scatter(ground.surface.soil, seed);
  return ground;
}

bool no_go_at(const sim::world::Ground& ground, const sim::components::WheeledVehicle& vehicle,
              terrain::Point p) {
  const sim::world::Soil* soil = sim::world::soil_at(ground.surface.soil, p);
  if (!soil || vehicle.wheels <= 0) return false;
  const double slope = slope_at(ground, p);
  return !sim::components::footing(*soil, vehicle, slope, slope).bears;
}

std::optional<TrueWay> true_way(const sim::world::Ground& ground, const TrueLimits& limits,
                                terrain::Point from, terrain::Point to) {
  const terrain::Grid& grid = ground.site->grid();
  if (!grid.contains(from) || !grid.contains(to)) return std::nullopt;
  const std::vector<bool> free = free_cells(ground, limits);
  const std::size_t start = grid.index(grid.cell_of(from)), goal = grid.index(grid.cell_of(to));
  if (!free[start] || !free[goal]) return std::nullopt;
  std::vector<double> length(grid.cell_count(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> before(grid.cell_count(), start);
  using Open = std::pair<double, std::size_t>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  length[start] = 0;
  open.emplace(0, start);
  const auto is_free = [&](terrain::Cell c) { return grid.contains(c) && free[grid.index(c)]; };
  while (!open.empty()) {
    const auto [way, index] = open.top();
    open.pop();
    if (way > length[index]) continue;
    if (index == goal) break;
    const terrain::Cell c = grid.cell_at(index);
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const terrain::Cell next{c.column + dx, c.row + dy};
        if ((dx == 0 && dy == 0) || !is_free(next) || !is_free({c.column + dx, c.row}) ||
            !is_free({c.column, c.row + dy}))
          continue;
        const double longer = way + grid.resolution * std::hypot(dx, dy);
        if (longer >= length[grid.index(next)]) continue;
        length[grid.index(next)] = longer;
        before[grid.index(next)] = index;
        open.emplace(longer, grid.index(next));
      }
    }
  }
  if (!std::isfinite(length[goal])) return std::nullopt;
  TrueWay out{length[goal], {}};
  for (std::size_t i = goal; i != start; i = before[i]) out.points.push_back(grid.centre(grid.cell_at(i)));
  out.points.push_back(grid.centre(grid.cell_at(start)));
  std::ranges::reverse(out.points);
  return out;
}

}  // namespace roci::scenario
