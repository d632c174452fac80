// Two executives that led apart each have a record of a goal; these rules merge them into one.
#pragma once

#include <optional>

#include "exec_svc/goals/goal_set.hpp"

namespace roci::exec::goals {

/// Returns what `ours` becomes when `theirs` is merged into it, or nothing if it stays as it is. Nothing that was
/// acknowledged on either side is lost:
/// - of two wishes the one with more changes behind it counts (the revision; of equal ones ours);
/// - what one side saw achieved is achieved, unless the other side has changed the goal since;
/// - a recall beats everything but an achieved goal: what is done cannot be taken back.
/// A goal that they have given up (failed, dropped) and we have not stays open.
std::optional<GoalRecord> merged(const GoalRecord& ours, const GoalRecord& theirs);

}  // namespace roci::exec::goals
