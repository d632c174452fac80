#include <algorithm>
#include <array>

#include "ground_console/cli/timelines.hpp"
#include "ground_console/cli/watch/axis.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::console::cli::watch {
namespace {

using temporal::ProjectedChange;
using temporal::ProjectionKind;

constexpr std::array kHeights{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};

double value_at(const Level& level, std::int64_t time) {
  double out = level.before;
  for (const auto& [from, value] : level.changes) {
    if (from > time) break;
    out = value;
  }
  return out;
}

void draw_level(const Level& level, const std::string& unit, std::int64_t now, const Axis& axis,
                std::size_t row, Canvas& canvas) {
  double least = level.before;
  double most = level.before;
  for (const auto& [time, value] : level.changes) {
    least = std::min(least, value);
    most = std::max(most, value);
  }
  const double end = level.changes.empty() ? level.before : level.changes.back().second;
  const std::size_t label = axis.column() - axis.label();
  canvas.put(row, label + 4,
             level.name + " " + amount_text(value_at(level, now), unit) + " → " + amount_text(end, unit),
             Style::plain, axis.label() - 5);
  for (std::size_t column = axis.column(); column < axis.column() + axis.width(); ++column) {
    const std::int64_t time = axis.time_at(column);
    const double share = most > least ? (value_at(level, time) - least) / (most - least) : 0;
    const auto height = static_cast<std::size_t>(share * static_cast<double>(kHeights.size() - 1) + 0.5);
    canvas.put(row, column, kHeights[height], axis.column_of(now) < column ? Style::dim : Style::active);
  }
}

// Of a plan that no executive sends: none.
Timelines timelines_or_none(const lib::MissionView& view) {
  try {
    return timelines_of(view, {});
  } catch (const services::wire::WireError&) {
    return {};
  }
}

}  // namespace

std::vector<Level> levels_of(const lib::MissionView& view) {
  std::vector<Level> out;
  for (const auto& [name, changes] : timelines_or_none(view)) {
    const bool of_the_plan = std::ranges::any_of(
        changes, [](const ProjectedChange& change) { return change.kind == ProjectionKind::planned; });
    if (!of_the_plan || !std::holds_alternative<double>(changes.front().value)) continue;
    Level level{name, {}, 0};
    for (const ProjectedChange& change : changes) {
      const double* value = std::get_if<double>(&change.value);
      if (change.kind == ProjectionKind::planned || value == nullptr) continue;
      level.changes.emplace_back(change.time.count(), *value);
    }
    if (view.timelines().contains(name) && !level.changes.empty())
      level.before = level.changes.front().second;
    out.push_back(std::move(level));
  }
  return out;
}

void draw_levels(const lib::MissionView& view, const std::vector<Level>& levels, const MissionWords& words,
                 const Rectangle& area, Canvas& canvas) {
  if (!view.plan() || area.width < Axis::kLeast || area.height < levels.size() + 1) return;
  const Axis axis(view, area);
  canvas.put(area.row, area.column, "Levels, now → at the end of the plan", Style::title);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    draw_level(levels[i], words.unit_of(levels[i].name), view.now_us(), axis, area.row + 1 + i, canvas);
  }
}

}  // namespace roci::console::cli::watch
