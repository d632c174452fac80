#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {
namespace {

std::optional<double> number_of(const v1::Goal& goal, const std::string& argument) {
  for (const v1::Property& property : goal.arguments()) {
    if (property.name() != argument) continue;
    const std::string& text = property.value();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
  }
  return std::nullopt;
}

struct Mark {
  lib::Place place;
  std::string glyph;
  Style style;
  double radius_m = 0;  // around which the ground is marked, too
};

void add_goals(const lib::MissionView& view, std::vector<Mark>& out) {
  std::size_t number = 0;
  for (const auto& [key, status] : view.goals()) {
    const std::string letter(1, goal_letter(number++));
    const v1::Goal* goal = view.goal(key);
    if (goal == nullptr) continue;
    const auto x = number_of(*goal, "x"), y = number_of(*goal, "y");
    const bool achieved = status.goal_state() == v1::GOAL_ACHIEVED;
    const bool open = status.goal_state() == v1::GOAL_PENDING || status.goal_state() == v1::GOAL_PLANNED;
    if (x && y) out.push_back({{*x, *y}, letter, achieved ? Style::good : open ? Style::active : Style::bad});
  }
}

void add_hazards(const lib::MissionView& view, std::vector<Mark>& out) {
  for (const auto& [id, hazard] : view.hazards()) {
    if (!hazard.cleared()) out.push_back({{hazard.x_m(), hazard.y_m()}, "×", Style::bad});
  }
}

// All of these come in the order of drawing: what comes later lies above.
std::vector<Mark> marks_of(const lib::MissionView& view) {
  std::vector<Mark> out;
  for (const auto& [robot, way] : view.ways()) {
    for (const lib::Place& place : way) out.push_back({place, "·", Style::dim});
  }
  add_hazards(view, out);
  add_goals(view, out);
  for (const auto& [robot, way] : view.ways()) {
    if (!way.empty()) out.push_back({way.back(), "▲", Style::warning});
  }
  return out;
}

// What one robot knows: its own map and way, and where the others are.
std::vector<Mark> marks_of(const lib::MissionView& view, const Robot& robot) {
  std::vector<Mark> out;
  for (const v1::KnownMap* map : robot.maps) {
    for (const v1::MapObstacle& one : map->obstacles()) {
      const bool usable =
          std::isfinite(one.x_m()) && std::isfinite(one.y_m()) && std::isfinite(one.radius_m());
      if (one.cleared() || !usable) continue;
      const char* glyph = one.obstacle_kind() == v1::OBSTACLE_SOIL ? "≈" : "×";
      out.push_back({{one.x_m(), one.y_m()}, glyph, Style::bad, std::max(0.0, one.radius_m())});
    }
  }
  add_hazards(view, out);
  if (const auto way = view.ways().find(robot.name); way != view.ways().end())
    for (const lib::Place& place : way->second) out.push_back({place, "·", Style::active});
  add_goals(view, out);
  for (const auto& [name, way] : view.ways())
    if (name != robot.name && !way.empty()) out.push_back({way.back(), "△", Style::dim});
  if (robot.place) out.push_back({*robot.place, "▲", Style::warning});
  return out;
}

// 1, 2 or 5 times a power of ten, at most `length`.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double lead = length / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

// From where to where, and how much of it a column has.
struct Extent {
  double west = 0, north = 0, metres_a_column = 0.1;
};

Extent extent_of(const std::vector<Mark>& marks, std::size_t width, std::size_t rows) {
  double west = 1e300, east = -1e300, south = 1e300, north = -1e300;
  for (const Mark& mark : marks) {
    west = std::min(west, mark.place.x_m - mark.radius_m);
    east = std::max(east, mark.place.x_m + mark.radius_m);
    south = std::min(south, mark.place.y_m - mark.radius_m);
    north = std::max(north, mark.place.y_m + mark.radius_m);
  }
  return {west, north,
          std::max({(east - west) / static_cast<double>(width - 1),
                    (north - south) / static_cast<double>(2 * (rows - 1)), 0.1})};
}

void draw_ground_of(const Mark& mark, const Extent& extent, const Rectangle& area, std::size_t rows,
                    Canvas& canvas) {
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < area.width; ++column) {
      const double x = extent.west + static_cast<double>(column) * extent.metres_a_column;
      const double y = extent.north - static_cast<double>(row) * 2 * extent.metres_a_column;
      if (std::hypot(x - mark.place.x_m, y - mark.place.y_m) <= mark.radius_m)
        canvas.put(area.row + 1 + row, area.column + column, "░", mark.style);
    }
  }
}

void draw_marks(const std::vector<Mark>& marks, const Extent& extent, const Rectangle& area, Canvas& canvas) {
  const std::size_t rows = area.height - 1;
  for (const Mark& mark : marks)
    if (mark.radius_m > 0) draw_ground_of(mark, extent, area, rows, canvas);
  for (const Mark& mark : marks) {
    const auto column =
        static_cast<std::size_t>(std::lround((mark.place.x_m - extent.west) / extent.metres_a_column));
    const auto row =
        static_cast<std::size_t>(std::lround((extent.north - mark.place.y_m) / (2 * extent.metres_a_column)));
    canvas.put(area.row + 1 + std::min(row, rows - 1), area.column + std::min(column, area.width - 1),
               mark.glyph, mark.style);
  }
}

void draw_head(const std::string& title, const std::string& legend, const Extent& extent,
               const Rectangle& area, Canvas& canvas) {
  const double bar_m = round_length(extent.metres_a_column * static_cast<double>(area.width) / 3);
  const auto bar = static_cast<std::size_t>(std::max(1L, std::lround(bar_m / extent.metres_a_column)));
  const std::size_t end = area.column + area.width;
  const auto put = [&](std::size_t column, const std::string& text, Style style) {
    return canvas.put(area.row, column, text, style, end > column ? end - column : 0);
  };
  std::size_t column = put(area.column, title, Style::title) + 2;
  column = put(column, "├", Style::dim);
  for (std::size_t i = 1; i < bar; ++i) column = put(column, "─", Style::dim);
  column = put(column, "┤ ", Style::dim);
  put(column, lib::value_text(bar_m) + " m   " + legend, Style::dim);
}

}  // namespace

void draw_map(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  const std::vector<Mark> marks = marks_of(view);
  if (marks.empty() || area.width < kLeastMapColumns || area.height < kLeastMapRows) return;
  const Extent extent = extent_of(marks, area.width, area.height - 1);
  draw_marks(marks, extent, area, canvas);
  draw_head("Way", "▲ robot  × obstacle", extent, area, canvas);
}

void draw_maps(const lib::MissionView& view, const std::vector<Robot>& robots,
               const std::vector<Rectangle>& areas, Canvas& canvas) {
  std::vector<Mark> all;
  std::vector<std::vector<Mark>> own;
  for (const Robot& robot : robots) {
    own.push_back(marks_of(view, robot));
    all.insert(all.end(), own.back().begin(), own.back().end());
  }
  if (all.empty()) return;
  for (std::size_t i = 0; i < std::min(robots.size(), areas.size()); ++i) {
    const Rectangle& area = areas[i];
    if (area.width < kLeastMapColumns || area.height < kLeastMapRows) continue;
    const Extent extent = extent_of(all, area.width, area.height - 1);
    draw_marks(own[i], extent, area, canvas);
    draw_head("Its map", "▲ it △ other × rock ≈ soil", extent, area, canvas);
  }
}

}  // namespace roci::console::cli::watch
