#include "pathplan_svc/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace roci::pathplan {
namespace {

constexpr std::size_t kMoves = 8;
// The moves go from east counter-clockwise; the odd ones are diagonal.
constexpr std::array<terrain::Cell, kMoves> kMove{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

// Calls visit(number of the move, index of the neighbour) for the moves that are allowed from a free cell, as
// is_free(cell) tells.
template <typename IsFree, typename Visit>
void for_each_move(const terrain::Grid& grid, std::size_t index, IsFree is_free, Visit visit) {
  const terrain::Cell c = grid.cell_at(index);
  std::array<bool, kMoves> open{};
  for (std::size_t k = 0; k < kMoves; ++k) {
    open[k] = is_free(terrain::Cell{c.column + kMove[k].column, c.row + kMove[k].row});
  }
  for (std::size_t k = 0; k < kMoves; ++k) {
    const bool diagonal = k % 2 == 1;
    if (!open[k] || (diagonal && !(open[k - 1] && open[(k + 1) % kMoves]))) continue;
    visit(k, grid.index({c.column + kMove[k].column, c.row + kMove[k].row}));
  }
}

}  // namespace

Regions::Regions(const Costmap& map, Ground ground) : region_(map.grid().cell_count(), 0) {
  const terrain::Grid& grid = map.grid();
  const auto counts = [&](std::size_t i) {
    return ground == Ground::known ? map.state(i) == CellState::free : map.may_be_free(i);
  };
  const auto is_free = [&](terrain::Cell c) { return grid.contains(c) && counts(grid.index(c)); };
  std::vector<std::size_t> frontier;
  for (std::size_t seed = 0; seed < region_.size(); ++seed) {
    if (region_[seed] != 0 || !counts(seed)) continue;
    const auto number = static_cast<std::uint32_t>(++count_);
    region_[seed] = number;
    frontier.push_back(seed);
    while (!frontier.empty()) {
      const std::size_t here = frontier.back();
      frontier.pop_back();
      for_each_move(grid, here, is_free, [&](std::size_t, std::size_t next) {
        if (region_[next] != 0) return;
        region_[next] = number;
        frontier.push_back(next);
      });
    }
  }
}

Polyline SearchTree::path_to(terrain::Cell target) const {
  Polyline path;
  if (!grid_.contains(target) || !reaches(target)) return path;
  path.push_back(grid_.centre(target));
  for (std::uint8_t move = move_[grid_.index(target)]; move != kSource; move = move_[grid_.index(target)]) {
    target = {target.column - kMove[move].column, target.row - kMove[move].row};
    path.push_back(grid_.centre(target));
  }
  std::reverse(path.begin(), path.end());
  return path;
}

bool SearchTree::holds(const Costmap& map, terrain::Cell target) const {
  if (!reaches(target) || !map.is_free(target)) return false;
  for (std::uint8_t move = move_[grid_.index(target)]; move != kSource; move = move_[grid_.index(target)]) {
    const terrain::Cell before{target.column - kMove[move].column, target.row - kMove[move].row};
    const bool open = map.is_free(before) && map.is_free(terrain::Cell{before.column, target.row}) &&
                      map.is_free(terrain::Cell{target.column, before.row});
    if (!open) return false;
    target = before;
  }
  return true;
}

GridSearch::GridSearch(const Costmap& map, const DriveModel& drive) {
  half_move_.reserve(map.grid().cell_count() * kMoves);
  for (std::size_t i = 0; i < map.grid().cell_count(); ++i) {
    const terrain::Gradient g = map.gradient(i);
    for (const terrain::Cell& move : kMove) {
      const double cells = std::sqrt(static_cast<double>(move.column * move.column + move.row * move.row));
      const double grade = (g.east * move.column + g.north * move.row) / cells;
      const double half = cells * map.grid().resolution / 2;
      half_move_.push_back(static_cast<float>(half * drive.pace(grade, map.roughness(i)).time));
    }
  }
}

SearchTree GridSearch::from(const Costmap& map, terrain::Cell source) const {
  SearchTree tree;
  tree.grid_ = map.grid();
  tree.move_.assign(map.grid().cell_count(), SearchTree::kNone);
  if (!map.is_free(source)) return tree;

  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::vector<float> cost(map.grid().cell_count(), std::numeric_limits<float>::infinity());
  const std::size_t start = map.grid().index(source);
  cost[start] = 0;
  tree.move_[start] = SearchTree::kSource;
  open.emplace(0.0F, static_cast<std::uint32_t>(start));
  const auto is_free = [&](terrain::Cell c) { return map.is_free(c); };
  while (!open.empty()) {
    const auto [here_cost, here] = open.top();
    open.pop();
    if (here_cost > cost[here]) continue;
    for_each_move(map.grid(), here, is_free, [&](std::size_t move, std::size_t next) {
      const float next_cost = here_cost + half_move_[here * kMoves + move] + half_move_[next * kMoves + move];
      if (next_cost >= cost[next]) return;
      cost[next] = next_cost;
      tree.move_[next] = static_cast<std::uint8_t>(move);
      open.emplace(next_cost, static_cast<std::uint32_t>(next));
    });
  }
  return tree;
}

}  // namespace roci::pathplan
