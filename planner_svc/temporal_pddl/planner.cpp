#include "planner_svc/temporal_pddl/planner.hpp"

#include <algorithm>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/pddl/check.hpp"
#include "core/pddl/forbidden.hpp"
#include "planner_svc/engine/function_words.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/dead_ends/mutex_dead_ends.hpp"
#include "planner_svc/temporal_pddl/dead_ends/resource_dead_ends.hpp"
#include "planner_svc/temporal_pddl/extraction/plan_builder.hpp"
#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/model_failure.hpp"
#include "planner_svc/temporal_pddl/grounding/remaining_plan.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "planner_svc/temporal_pddl/heuristics/landmark_count.hpp"
#include "planner_svc/temporal_pddl/improvement/improvement.hpp"
#include "planner_svc/temporal_pddl/improvement/restarts.hpp"
#include "planner_svc/temporal_pddl/improvement/warm_start.hpp"
#include "planner_svc/temporal_pddl/refining.hpp"
#include "planner_svc/temporal_pddl/search/portfolio.hpp"
#include "planner_svc/temporal_pddl/values/counted_functions.hpp"
#include "planner_svc/temporal_pddl/values/level_functions.hpp"

namespace roci::planner::temporal_pddl {

using call::Budget, call::Monitor, call::NamedGoal, call::Options, call::PlanningFailure, call::SearchLimits,
    call::Statistics;
using dead_ends::DeadEndDetectors, dead_ends::MutexDeadEnds, dead_ends::ResourceDeadEnds;
using engine::FunctionSource, engine::FunctionsMode;
using extraction::build_plan;
using grounding::Grounding, grounding::GroundingReport, grounding::ground, grounding::ground_remaining_plan;
using grounding::lifted::ModelFailure;
using heuristics::CostMeasure, heuristics::FfHeuristic, heuristics::Heuristic, heuristics::LandmarkCount;
using improvement::Restarts, improvement::improve, improvement::warm_start;
using search::Guide, search::PlanPrefix, search::SearchContext, search::SearchOutcome,
    search::search_portfolio;
using task::Task;
using temporal::Verdict;
using values::CountedFunctions, values::LevelFunctions;

namespace {

void require_model(const pddl::Domain& domain, const pddl::Problem& problem) {
  for (const auto& finding : pddl::check(domain)) throw ModelFailure(Verdict::invalid_input, finding);
  for (const auto& finding : pddl::check(problem, domain))
    throw ModelFailure(Verdict::invalid_input, finding);
  for (const auto& finding : pddl::forbidden_effects(domain, problem))
    throw ModelFailure(Verdict::unsupported, finding);
}

void describe(const Task& task, Statistics& statistics) {
  statistics.facts = task.fact_names.size();
  statistics.variables = task.layout.variables().size();
  statistics.numeric_variables = task.layout.numbers();
  statistics.actions = task.actions.size();
}

PlanPrefix improved(const SearchContext& context, PlanPrefix first, const Guide& guide, FfHeuristic& ff) {
  std::vector<Guide> guides{guide};
  std::optional<FfHeuristic> by_metric;
  DeadEndDetectors none;
  if (!context.task.metric.only_time()) {
    by_metric.emplace(context.task, CostMeasure::metric);
    guides.push_back({*by_metric, none, CostMeasure::metric});
  }
  Restarts restarts(context, guide, ff);
  return improve(std::move(first), guides, restarts, context);
}

// Why there is no plan: time alone, else a number that does not suffice, else what the search has seen.
void explain(FfHeuristic& ff, ResourceDeadEnds& resources, SearchOutcome outcome, Result& result) {
  if (auto late = ff.lateness()) {
    result.reason = late->reason;
    result.blocked = {std::move(*late)};
    return;
  }
  result.reason = resources.shortage_reason();
  if (!result.reason.empty()) return;
  result.reason = std::move(outcome.reason);
  result.blocked = std::move(outcome.blocked);
}

Grounding grounded(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
                   const Options& options, SearchLimits& limits, bool keeps_functions, Result& result) {
  GroundingReport report;
  report.keeps_functions = keeps_functions;
  const auto tell = [&] {
    result.functions = std::move(report.functions);
    result.warnings = std::move(report.warnings);
    result.statistics.temporally_inconsistent += report.shorter_than_separation;
  };
  try {
    Grounding grounding = ground(domain, problem, functions, options, limits, report);
    tell();
    return grounding;
  } catch (...) {
    tell();
    throw;
  }
}

// Names what searches have touched for whoever asked for it, when the call ends.
class Touched {
 public:
  Touched(const Task& task, std::vector<values::ActionInstance>* wanted, SearchLimits& limits)
      : task_(task), wanted_(wanted), marks_(wanted ? task.actions.size() : 0) {
    if (wanted) limits.mark_touched(&marks_);
  }

  void tell() const {
    if (!wanted_) return;
    for (std::size_t i = 0; i < marks_.size(); ++i) {
      const task::ActionId action(i);
      const auto arguments = task_.action_arguments[action];
      if (marks_[i]) wanted_->push_back({task_.actions[action].schema, {arguments.begin(), arguments.end()}});
    }
  }

 private:
  const Task& task_;
  std::vector<values::ActionInstance>* wanted_;
  std::vector<bool> marks_;  // by ActionId
};

void solve(const pddl::Domain& domain, const pddl::Problem& problem, const Attempt& attempt,
           std::span<const NamedGoal> goals, SearchLimits& limits, Result& result) {
  const Options& options = attempt.options;
  limits.phase("grounding");
  const Grounding grounding =
      grounded(domain, problem, attempt.functions, options, limits, attempt.keeps_functions, result);
  const Task& task = grounding.task;
  const Touched touched(task, attempt.touched, limits);
  describe(task, result.statistics);
  limits.hold(task.bytes());
  limits.phase("looking for landmarks");
  FfHeuristic ff(task);
  std::optional<LandmarkCount> landmarks;
  if (options.landmarks) landmarks.emplace(task, ff, limits);
  ResourceDeadEnds resources(task, options.resource_patience, limits);
  MutexDeadEnds mutexes(task, options.pair_patience, limits);
  DeadEndDetectors detectors;
  detectors.add(resources);
  detectors.add(mutexes);
  const Guide guide{landmarks ? static_cast<Heuristic&>(*landmarks) : ff, detectors, CostMeasure::duration};
  const SearchContext context{task, options, limits, result.statistics};
  SearchOutcome outcome;
  limits.phase("completing the earlier plan");
  outcome.plan = warm_start(context, ground_remaining_plan(task, attempt.remaining), guide);
  result.statistics.from_remaining = outcome.plan.has_value();
  if (!outcome.plan) outcome = search_portfolio(context, guide, ff);
  if (outcome.plan) {
    limits.first_plan_found();
    result.statistics.for_first_plan = result.statistics.evaluated;
    const PlanPrefix best = improved(context, std::move(*outcome.plan), guide, ff);
    result.plan = build_plan(domain, grounding, best, options, goals);
    result.verdict = Verdict::solved;
  } else {
    result.verdict = Verdict::unsolvable;
    explain(ff, resources, std::move(outcome), result);
  }
  touched.tell();
}

// Does the work, and gives what it throws for the model, the budget or the memory as a verdict.
template <typename Work>
void guarded(Result& result, Work work) {
  try {
    work();
  } catch (const ModelFailure& failure) {
    result.verdict = failure.verdict();
    result.reason = failure.reason();
    result.where = failure.where();
  } catch (const PlanningFailure& failure) {
    result.verdict = failure.verdict();
    result.reason = failure.reason();
    result.blocked = failure.blocked();
  } catch (const std::bad_alloc&) {
    result.verdict = Verdict::out_of_memory;
    result.reason = "the system has no more memory";
  }
}

Result plan_once(const pddl::Domain& domain, const pddl::Problem& problem, const Attempt& attempt,
                 const Monitor& monitor, std::span<const NamedGoal> goals) {
  Result result;
  SearchLimits limits(attempt.budget, monitor);
  guarded(result, [&] { solve(domain, problem, attempt, goals, limits, result); });
  if (!result.plan) result.statistics.for_first_plan = result.statistics.evaluated;
  result.statistics.peak_bytes = limits.peak_bytes();
  return result;
}

// That no plan exists is not proved where an owner found no value with the effort that it spent.
void doubt_unknown_values(Result& result) {
  const std::string doubt = engine::doubt_of(result.functions);
  if (result.verdict != Verdict::unsolvable || doubt.empty()) return;
  result.verdict = Verdict::timeout;
  result.lacks_values = true;
  result.reason = doubt + "; without that, " + result.reason;
}

}  // namespace

Result plan(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
            const Budget& budget, const Monitor& monitor, const Options& options,
            std::span<const pddl::PlanStep> remaining, std::span<const NamedGoal> goals) {
  CountedFunctions owners(functions);
  LevelFunctions at_levels(owners, domain.level_parameters);
  const auto attempt = [&](const Attempt& one) { return plan_once(domain, problem, one, monitor, goals); };
  Result result;
  guarded(result, [&] {
    require_model(domain, problem);
    result = options.functions == FunctionsMode::eager || domain.modules.empty()
                 ? attempt({at_levels, budget, options, remaining})
                 : plan_refining({domain, problem, at_levels, budget, monitor, options, remaining}, attempt);
  });
  doubt_unknown_values(result);
  result.statistics.function_requests = owners.requests();
  result.statistics.exact_values = owners.exact();
  result.statistics.cheap_values = owners.cheap();
  return result;
}

}  // namespace roci::planner::temporal_pddl
