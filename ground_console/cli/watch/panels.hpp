// These are the panels of the screen. Each draws into a rectangle of the canvas and keeps within it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/cli/robots.hpp"
#include "ground_console/cli/watch/canvas.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::watch {

/// Holds a rectangle of the canvas, in characters.
struct Rectangle {
  std::size_t row = 0, column = 0, width = 0, height = 0;
};

inline constexpr std::int64_t kNotYet = -1;  ///< StepStatus: not started, not ended

/// Goals are lettered A, B, … in the order of the view, here and on the map.
void draw_goals(const lib::MissionView& view, const Rectangle& area, Canvas& canvas);

/// Way, robot, goals' places and hazards; north is up, a column as wide as half a row is high. Draws nothing
/// while no place is known.
void draw_map(const lib::MissionView& view, const Rectangle& area, Canvas& canvas);

inline constexpr std::size_t kLeastMapColumns = 12, kLeastMapRows = 4;

/// What each robot knows, all at one scale: its own map with the ground that it keeps clear of, its way, where it is,
/// where the others are. One area for each robot; draws nothing while no place is known.
void draw_maps(const lib::MissionView& view, const std::vector<Robot>& robots,
               const std::vector<Rectangle>& areas, Canvas& canvas);

/// Several robots side by side, each with its place, its states, its map in words and as a picture, and below them the
/// states of the team. Returns how many rows it took.
std::size_t draw_robots(const lib::MissionView& view, const std::vector<Robot>& robots,
                        const MissionWords& words, const Rectangle& area, Canvas& canvas);

/// Decisions that are open, and repairs, those under way first. Returns how many rows it took:
/// none where there are none.
std::size_t draw_open(const lib::MissionView& view, const Rectangle& area, Canvas& canvas);

/// Windows and activities over time: done, running, planned, and a line for now.
void draw_plan(const lib::MissionView& view, const Rectangle& area, Canvas& canvas);

/// A number that the plan changes: what has come about, then what is still to come.
struct Level {
  std::string name;
  /// (mission time in us, value from then on), by time
  std::vector<std::pair<std::int64_t, double>> changes;
  /// The first change; 0 for a number that nobody observes, which is the change since the plan began.
  double before = 0;
};
std::vector<Level> levels_of(const lib::MissionView& view);

/// A curve for each from its least to its highest value, over the axis of the plan: bright until now, dim beyond.
/// Draws all of them or nothing.
void draw_levels(const lib::MissionView& view, const std::vector<Level>& levels, const MissionWords& words,
                 const Rectangle& area, Canvas& canvas);

void draw_events(const lib::MissionView& view, const Rectangle& area, Canvas& canvas);

/// Letter of the n-th goal.
inline char goal_letter(std::size_t n) { return static_cast<char>(n < 26 ? 'A' + n : '*'); }

}  // namespace roci::console::cli::watch
