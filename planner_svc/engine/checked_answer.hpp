// This file takes one call from the request to an answer that may be sent.
#pragma once

#include <string>
#include <vector>

#include "planner_svc/engine/table.hpp"

namespace roci::planner::engine {

/// Answers the request by the engine of the table that it names, and never throws. An engine that is not
/// there is `unsupported`, with the names of those that are. What goes wrong inside, and a plan that the
/// engine's checker refuses, is `crashed` with its reason: such a plan is not given out. Where there is no plan for
/// want of values that owners did not find, they are asked for these up to five times in all, and each time that one
/// came the engine plans again with the rest of the budget.
Answer answer_checked(const Table& table, const Request& request, const Limits& limits,
                      FunctionSource& functions);

/// Returns "refused by its checker: …; …" with faults() or with what it throws, or an empty text if the plan
/// may be sent.
std::string refusal_of(const Checker& checker, const CheckedPlan& checked);

}  // namespace roci::planner::engine
