// What roci-plan says of a result besides the plan itself: exit code, statistics, JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "planner_svc/temporal_pddl/extraction/plan.hpp"
#include "planner_svc/temporal_pddl/result.hpp"

namespace roci::planner::temporal_pddl::cli {

/// Gives the exit code for a wrong command line (EX_USAGE).
inline constexpr int kUsageError = 64;

/// Returns the exit code of a verdict, as docs/exit-codes.md lists them.
int exit_code(temporal::Verdict verdict);

/// Returns a verdict as roci-plan tells it: what went wrong inside it is its own defect.
std::string name_of(temporal::Verdict verdict);

/// Returns what `--stats` writes. Others script against its keys: they are added to, never renamed.
nlohmann::json statistics_json(const Result& result, double wall_s);

/// Returns the activities of a plan with their times, in seconds.
nlohmann::json plan_json(const extraction::Plan& plan);

}  // namespace roci::planner::temporal_pddl::cli
