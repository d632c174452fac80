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
};

// In the order of drawing: what comes later lies above.
std::vector<Mark> marks_of(const lib::MissionView& view) {
  std::vector<Mark> out;
  for (const auto& [robot, way] : view.ways()) {
    for (const lib::Place& place : way) out.push_back({place, "·", Style::dim});
  }
  for (const auto& [id, hazard] : view.hazards()) {
    if (!hazard.cleared()) out.push_back({{hazard.x_m(), hazard.y_m()}, "×", Style::bad});
  }
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
  for (const auto& [robot, way] : view.ways()) {
    if (!way.empty()) out.push_back({way.back(), "▲", Style::warning});
  }
  return out;
}

// 1, 2 or 5 times a power of ten, at most `length`.
double round_length(double length) {
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  const double lead = length / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

}  // namespace

void draw_map(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  const std::vector<Mark> marks = marks_of(view);
  if (marks.empty() || area.width < 12 || area.height < 4) return;
  const auto [west, east] = std::ranges::minmax(marks, {}, [](const Mark& mark) { return mark.place.x_m; });
  const auto [south, north] = std::ranges::minmax(marks, {}, [](const Mark& mark) { return mark.place.y_m; });
  const std::size_t rows = area.height - 1;
  const double metres_a_column =
      std::max({(east.place.x_m - west.place.x_m) / static_cast<double>(area.width - 1),
                (north.place.y_m - south.place.y_m) / static_cast<double>(2 * (rows - 1)), 0.1});
  for (const Mark& mark : marks) {
    const auto column =
        static_cast<std::size_t>(std::lround((mark.place.x_m - west.place.x_m) / metres_a_column));
    const auto row =
        static_cast<std::size_t>(std::lround((north.place.y_m - mark.place.y_m) / (2 * metres_a_column)));
    canvas.put(area.row + 1 + std::min(row, rows - 1), area.column + std::min(column, area.width - 1),
               mark.glyph, mark.style);
  }
  const double bar_m = round_length(metres_a_column * static_cast<double>(area.width) / 3);
  const auto bar = static_cast<std::size_t>(std::max(1L, std::lround(bar_m / metres_a_column)));
  std::size_t column = canvas.put(area.row, area.column, "Way", Style::title) + 2;
  column = canvas.put(area.row, column, "├", Style::dim);
  for (std::size_t i = 1; i < bar; ++i) column = canvas.put(area.row, column, "─", Style::dim);
  column = canvas.put(area.row, column, "┤ ", Style::dim);
  canvas.put(area.row, column, lib::value_text(bar_m) + " m   ▲ robot  × obstacle", Style::dim);
}

}  // namespace roci::console::cli::watch
