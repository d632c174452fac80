#include "planner_svc/temporal_pddl/planner.hpp"

#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "core/pddl/check.hpp"
#include "core/pddl/forbidden.hpp"
#include "planner_svc/temporal_pddl/dead_ends/avoids_dead_pairs.hpp"
#include "planner_svc/temporal_pddl/dead_ends/within_resources.hpp"
#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/refusal.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/heuristics/landmark_count.hpp"
#include "planner_svc/temporal_pddl/improvement/fresh_starts.hpp"
#include "planner_svc/temporal_pddl/improvement/improvement.hpp"
#include "planner_svc/temporal_pddl/improvement/warm_start.hpp"
#include "planner_svc/temporal_pddl/plan/plan_builder.hpp"
#include "planner_svc/temporal_pddl/search/search.hpp"
#include "planner_svc/temporal_pddl/watch.hpp"

namespace roci::planner::temporal_pddl {

namespace {

void require_model(const pddl::Domain& domain, const pddl::Problem& problem) {
  for (const auto& finding : pddl::check(domain)) throw Refusal(Verdict::invalid_input, finding);
  for (const auto& finding : pddl::check(problem, domain)) throw Refusal(Verdict::invalid_input, finding);
  for (const auto& finding : pddl::forbidden_effects(domain, problem))
    throw Refusal(Verdict::unsupported, finding);
}

void describe(const Task& task, Statistics& statistics) {
  statistics.facts = task.fact_names.size();
  statistics.variables = task.layout.variables().size();
  statistics.numeric_variables = task.layout.numbers();
  statistics.actions = task.actions.size();
}

PlanPrefix improved(const Task& task, PlanPrefix first, Heuristic& heuristic, FfHeuristic& ff,
                    const Options& options, Watch& watch, Statistics& statistics) {
  std::vector<Guide> guides{{heuristic, CostMeasure::duration}};
  std::optional<FfHeuristic> by_metric;
  if (!task.metric.only_time()) {
    by_metric.emplace(task, CostMeasure::metric);
    guides.push_back({*by_metric, CostMeasure::metric});
  }
  FreshStarts fresh_starts(task, heuristic, ff, options, watch, statistics);
  return improve(task, std::move(first), guides, fresh_starts, options, watch, statistics);
}

void solve(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
           const Options& options, std::span<const pddl::PlanStep> remaining, Watch& watch, Result& result) {
  require_model(domain, problem);
  const Grounding grounding = ground(domain, problem, functions, options, watch, result.functions);
  describe(grounding.task, result.statistics);
  watch.hold(grounding.task.bytes());
  FfHeuristic ff(grounding.task);
  std::optional<LandmarkCount> landmarks;
  if (options.landmarks) landmarks.emplace(grounding.task, ff, watch);
  Heuristic& guidance = landmarks ? static_cast<Heuristic&>(*landmarks) : ff;
  WithinResources within(grounding.task, guidance, options.resource_patience, watch);
  AvoidsDeadPairs heuristic(grounding.task, within, options.pair_patience, watch);
  SearchOutcome outcome;
  outcome.plan = warm_start(grounding.task, remaining, {heuristic, CostMeasure::duration}, options, watch,
                            result.statistics);
  result.statistics.from_remaining = outcome.plan.has_value();
  if (!outcome.plan) outcome = search(grounding.task, heuristic, ff, options, watch, result.statistics);
  if (outcome.plan) {
    watch.first_plan_found();
    const PlanPrefix best =
        improved(grounding.task, std::move(*outcome.plan), heuristic, ff, options, watch, result.statistics);
    result.plan = build_plan(domain, grounding, best, options);
    result.verdict = Verdict::solved;
  } else {
    result.verdict = Verdict::unsolvable;
    result.reason = ff.why_too_late();
    if (result.reason.empty()) result.reason = within.why_too_little();
    if (result.reason.empty()) result.reason = std::move(outcome.reason);
  }
}

}  // namespace

Result plan(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
            const Budget& budget, const Monitor& monitor, const Options& options,
            std::span<const pddl::PlanStep> remaining) {
  Result result;
  Watch watch(budget, monitor);
  try {
    solve(domain, problem, functions, options, remaining, watch, result);
  } catch (const Refusal& refusal) {
    result.verdict = refusal.verdict();
    result.reason = refusal.reason();
    result.where = refusal.where();
  } catch (const std::bad_alloc&) {
    result.verdict = Verdict::out_of_memory;
    result.reason = "the system has no more memory";
  }
  result.statistics.peak_bytes = watch.peak_bytes();
  return result;
}

}  // namespace roci::planner::temporal_pddl
