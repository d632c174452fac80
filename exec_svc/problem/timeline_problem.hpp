// This file writes a problem for engines that plan on timelines.
#pragma once

#include "exec_svc/problem/situation.hpp"

namespace roci::exec::problem {

/// Writes state, predictions and objects. The state holds every timeline that was observed, as the forecast changes it.
/// A predicted window is true at the origin if it is open then, false if it is open now and closes before; each later
/// opening and closing is a prediction. Objects are the mission's and those of goals; dynamic ones, and those of goals
/// that have ended, appear only while a state names them.
Problem write_timeline_problem(const Situation& situation);

}  // namespace roci::exec::problem
