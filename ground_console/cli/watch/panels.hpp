// The panels of the screen. Each draws into a rectangle of the canvas and keeps within it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ground_console/cli/watch/canvas.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console {

struct Rectangle {
  std::size_t row = 0, column = 0, width = 0, height = 0;
};

inline constexpr std::int64_t kNotYet = -1;  // StepStatus: not started, not ended

// Goals are lettered A, B, … in the order of the view, here and on the map.
void draw_goals(const MissionView& view, const Rectangle& area, Canvas& canvas);

// Way, robot, goals' places and hazards; north is up, a column as wide as half a row is high. Draws nothing
// while no place is known.
void draw_map(const MissionView& view, const Rectangle& area, Canvas& canvas);

// Windows and activities over time: done, running, planned, and a line for now.
void draw_plan(const MissionView& view, const Rectangle& area, Canvas& canvas);

void draw_events(const MissionView& view, const Rectangle& area, Canvas& canvas);

// Letter of the n-th goal.
inline char goal_letter(std::size_t n) { return static_cast<char>(n < 26 ? 'A' + n : '*'); }

}  // namespace roci::console
