#include "ground_console/cli/watch/screen.hpp"

#include <algorithm>

#include "ground_console/cli/table.hpp"
#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {
namespace {

constexpr std::size_t kGoals = 96;      // columns; the map takes what is left beside them
constexpr std::size_t kLeastMap = 24;   // columns
constexpr std::size_t kNarrowest = 76;  // columns, for a map beside goals that are cut short
constexpr std::size_t kMapRows = 12;
constexpr std::size_t kEventRows = 9;  // fewer on a low terminal, so that the plan has room
constexpr std::size_t kLeastPlan = 8;  // rows; below that the plan takes those of the levels

// Returns the column behind it.
std::size_t draw_head(const lib::MissionView& view, Canvas& canvas) {
  if (!view.mission()) return canvas.put(0, 0, "waiting for exec_svc", Style::warning) + 3;
  const v1::MissionStatus& mission = *view.mission();
  std::size_t column = canvas.put(0, 0, mission.mission(), Style::title) + 3;
  if (view.executives().size() > 1) column = canvas.put(0, column, view.executive(), Style::title) + 3;
  column = canvas.put(0, column, lib::clock_text(view.now_us()), Style::title) + 3;
  column = canvas.put(0, column, lib::name_of(mission.phase()),
                      mission.phase() == v1::PHASE_SAFE ? Style::bad : Style::active) +
           3;
  column = canvas.put(0, column,
                      "plan " + std::to_string(mission.plan_version()) + ", " +
                          std::to_string(mission.replans()) + " replans") +
           3;
  if (!mission.outcome().empty()) {
    column = canvas.put(0, column, "result: " + mission.outcome(),
                        mission.outcome() == "achieved" ? Style::good : Style::bad) +
             3;
  }
  if (const v1::LeaseMessage* leader = view.leader())
    column =
        canvas.put(0, column, lib::pair_text(*leader), leader->entitled() ? Style::dim : Style::warning) + 3;
  return column;
}

// States and levels as last observed, the subsystem's name without its owner's.
void draw_robot(const lib::MissionView& view, const std::vector<Robot>& robots, const MissionWords& words,
                std::size_t row, Canvas& canvas) {
  std::size_t column = canvas.put(row, 0, "Robot", Style::title) + 2;
  for (const auto& [name, observation] : view.timelines()) {
    const auto dot = name.find('.');
    const bool battery = name.ends_with(".battery");
    const bool robot = dot != std::string::npos && !robots.empty() && name.substr(0, dot) == robots[0].name;
    if (!robot || (observation.observed().kind() != v1::VALUE_STATE && !battery)) continue;
    const std::string subsystem = name.substr(dot + 1);
    const v1::TimelineValue& value = observation.observed();
    const std::string text = value.kind() == v1::VALUE_NUMBER
                                 ? amount_text(value.number(), words.unit_of(name))
                                 : lib::value_text(value);
    if (column + columns_of(subsystem) + 1 + columns_of(text) + 4 > canvas.width()) {
      canvas.put(row, column, "…", Style::dim);
      return;
    }
    column = canvas.put(row, column, subsystem + " ", Style::dim);
    column = canvas.put(row, column, text) + 3;
  }
}

}  // namespace

Canvas watch_screen(const lib::MissionView& view, std::size_t width, std::size_t height,
                    const MissionWords& words) {
  Canvas canvas(width, height);
  const std::size_t head_end = draw_head(view, canvas);
  const bool map_fits = width >= kNarrowest;
  const std::size_t goals_width = width >= kGoals + kLeastMap ? kGoals : map_fits ? width * 3 / 5 : width;
  const std::vector<Robot> robots = robots_of(view);
  const bool several = robots.size() > 1;  // then each has a map of its own beside the others
  const bool one_map = map_fits && !several;
  const std::size_t wanted =
      std::max(view.goals().size() + 1, one_map && !view.ways().empty() ? kMapRows : 0);
  const std::size_t top = std::min(wanted, several ? height / 6 : height / 3);
  draw_goals(view, {2, 0, std::min(goals_width, kGoals), top}, canvas);
  if (one_map) draw_map(view, {2, goals_width + 1, width - goals_width - 1, top}, canvas);
  std::size_t robots_height = 1;
  if (several) {
    robots_height = draw_robots(view, robots, words, {top + 3, 0, width, height * 2 / 5}, canvas);
  } else {
    draw_robot(view, robots, words, top + 3, canvas);
  }
  const std::size_t open_row = top + 4 + robots_height;
  const std::size_t open = draw_open(view, {open_row, 0, width, height / 6}, canvas);
  const std::size_t plan_row = open_row + open + (open > 0 ? 1 : 0);
  // With the title; what few events leave free is the plan's.
  const std::size_t event_rows =
      std::min(std::clamp<std::size_t>(height / 4, 4, kEventRows), view.events().size() + 1);
  const std::size_t events_row = height > plan_row + event_rows ? height - event_rows : plan_row;
  const std::vector<Level> levels = levels_of(view);
  const std::size_t levels_height = levels.empty() ? 0 : levels.size() + 2;
  const std::size_t steps = view.plan() ? view.plan()->activities().size() + 2 : 0;
  const std::size_t room = events_row > plan_row ? events_row - plan_row : 0;
  const std::size_t plan_height =
      std::min(steps, room > levels_height + kLeastPlan ? room - levels_height - 1
                                                        : std::max<std::size_t>(room, 1) - 1);
  draw_plan(view, {plan_row, 0, width, plan_height}, canvas);
  std::size_t after = plan_row + plan_height + (plan_height > 0 ? 1 : 0);
  if (!levels.empty() && after + levels_height <= events_row) {
    draw_levels(view, levels, words, {after, 0, width, levels_height}, canvas);
    after += levels_height;
  }
  draw_events(view, {after, 0, width, height > after ? height - after : 0}, canvas);
  constexpr std::string_view kHelp = "q ends the view";
  if (height > 2 && width >= head_end + kHelp.size()) canvas.put(0, width - kHelp.size(), kHelp, Style::dim);
  return canvas;
}

}  // namespace roci::console::cli::watch
