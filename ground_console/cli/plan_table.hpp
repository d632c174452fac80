// This file shows the running plan as a table: what, with which arguments, when, and for which goals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli {

/// A row for each activity, and what stands on values of an older model (plan_values.hpp). Rows come in the order of
/// the starts; of a plan with levels each activity has its parts behind it, further in, and a column names the level;
/// of one that commands several robots one names whose. `planned` is its start in the schedule of earliest times that
/// the plan came with and its least duration, `window` when it may start as things stand, `executed` when it did start
/// and end. "no plan yet" without a plan.
std::string plan_table(const lib::MissionView& view);

/// The arguments of the activity in words: of an action that was bound to commands those of its first command.
const std::vector<v1::Property>& arguments_of(const v1::PlanActivity& activity);

/// Tells whether its activities name levels or parents (R130).
bool has_levels(const v1::Plan& plan);

/// The robot whose subsystem the activity commands, as the command says or the service that owns it; empty:
/// nobody's, or not known yet.
std::string robot_of(const lib::MissionView& view, const v1::PlanActivity& activity);

/// Mission time in microseconds at which an activity starts in the plan's schedule of earliest times; -1 without one.
std::int64_t planned_start_us(const v1::Plan& plan, const v1::PlanActivity& activity);

}  // namespace roci::console::cli
