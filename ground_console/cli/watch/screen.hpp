// This is the whole screen of `roci watch`: mission, goals, a map of the way, the plan as bars over time,
// what happened last.
#pragma once

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/cli/watch/canvas.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::watch {

/// `words` gives the units of numbers; numbers without one stand alone.
Canvas watch_screen(const lib::MissionView& view, std::size_t width, std::size_t height,
                    const MissionWords& words = {});

}  // namespace roci::console::cli::watch
