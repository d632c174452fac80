#include "planner_svc/temporal_pddl/cli/result_json.hpp"

#include <sys/resource.h>

#include <chrono>

namespace roci::planner::temporal_pddl::cli {

using call::Statistics;
using extraction::Plan;
using temporal::Verdict;

namespace {

constexpr int kDefect = 8;

}  // namespace

int exit_code(Verdict verdict) {
  switch (verdict) {
    case Verdict::solved:
      return 0;
    case Verdict::unsolvable:
      return 1;
    case Verdict::invalid_input:
      return 2;
    case Verdict::unsupported:
      return 3;
    case Verdict::timeout:
      return 4;
    case Verdict::out_of_memory:
      return 5;
    case Verdict::function_unavailable:
      return 6;
    case Verdict::cancelled:
      return 7;
    case Verdict::crashed:
      return kDefect;
    case Verdict::no_reply:
      break;  // the engine does not say this of itself
  }
  return kUsageError;
}

std::string name_of(Verdict verdict) {
  return verdict == Verdict::crashed ? "internal error" : std::string(temporal::to_string(verdict));
}

nlohmann::json statistics_json(const Result& result, double wall_s) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const Statistics& statistics = result.statistics;
  return {{"verdict", name_of(result.verdict)},
          {"reason", result.reason},
          {"warnings", result.warnings},
          {"makespan",
           result.plan ? nlohmann::json(temporal::to_seconds(result.plan->makespan)) : nlohmann::json()},
          {"metric", result.plan ? nlohmann::json(result.plan->metric) : nlohmann::json()},
          {"actions", result.plan ? nlohmann::json(result.plan->activities.size()) : nlohmann::json()},
          {"wall_s", wall_s},
          {"peak_rss_kb", usage.ru_maxrss},
          {"expanded", statistics.expanded},
          {"evaluated", statistics.evaluated},
          {"generated", statistics.generated},
          {"temporally_inconsistent", statistics.temporally_inconsistent},
          {"dominated", statistics.dominated},
          {"hopeless", statistics.dead_ends},
          {"function_requests", statistics.function_requests},
          {"exact_values", statistics.exact_values},
          {"cheap_values", statistics.cheap_values},
          {"rounds", statistics.rounds},
          {"exhausted", statistics.exhausted},
          {"bytes_per_state", statistics.bytes_per_state},
          {"from_remaining", statistics.from_remaining},
          {"engine_peak_bytes", statistics.peak_bytes},
          {"facts", statistics.facts},
          {"variables", statistics.variables},
          {"numeric_variables", statistics.numeric_variables},
          {"ground_actions", statistics.actions}};
}

nlohmann::json plan_json(const Plan& plan) {
  auto activities = nlohmann::json::array();
  for (const auto& activity : plan.activities) {
    const auto& start = plan.network.points[activity.start_point];
    nlohmann::json entry = {{"name", activity.name},
                            {"arguments", activity.arguments},
                            {"start", temporal::to_seconds(activity.start)},
                            {"duration", temporal::to_seconds(activity.end - activity.start)},
                            {"earliest_start", temporal::to_seconds(start.earliest)}};
    if (start.latest != temporal::no_bound) entry["latest_start"] = temporal::to_seconds(start.latest);
    activities.push_back(std::move(entry));
  }
  return activities;
}

}  // namespace roci::planner::temporal_pddl::cli
