#include "planner_svc/temporal_pddl/grounding/grounder.hpp"

#include <span>
#include <string>
#include <utility>

#include "planner_svc/temporal_pddl/grounding/encoding/task_builder.hpp"
#include "planner_svc/temporal_pddl/grounding/impossible_actions.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/instantiate.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/compression_safety.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/reachability.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/defined_numbers.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/envelopes.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/read_sets.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relevance.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/timed_windows.hpp"
#include "planner_svc/temporal_pddl/grounding/unreachable_goal.hpp"

namespace roci::planner::temporal_pddl::grounding {

using call::Options, call::SearchLimits;
using encoding::build_task;
using engine::FunctionSource;
using instantiation::Disjunction, instantiation::GroundModel, instantiation::instantiate;
using invariants::Compression, invariants::find_compression, invariants::find_mutex_groups;
using lifted::ConstantFunctions, lifted::LiftedAction, lifted::StaticModel, lifted::Symbols,
    lifted::lower_actions;
using reachability::explore;
using simplification::UndefinedNumber, simplification::drop_irrelevant_effects,
    simplification::extract_timed_windows, simplification::prune, simplification::require_values,
    simplification::settle_read_sets, simplification::split_envelopes_by_duration;
using task::FunctionId, task::ObjectId, task::Task;

namespace {

constexpr std::size_t kMostWarnings = 10;

std::string text(const std::string& name, std::span<const ObjectId> objects, const Symbols& symbols) {
  std::string result = "(" + name;
  for (const ObjectId object : objects) result += " " + symbols.name(object);
  return result + ")";
}

std::string warning(const pddl::Problem& problem, const std::string& what) {
  return problem.file + ":" + std::to_string(problem.where.line) + ":" +
         std::to_string(problem.where.column) + ": warning: " + what;
}

std::string lacks_value(const std::string& fluent) {
  return fluent +
         " has no initial value, and nothing assigns one: no condition on it holds, and no action that reads "
         "or changes it can run (add (= " +
         fluent + " …) to :init)";
}

// Names the numbers that have no value though something reads them, and will not get one.
void warn_of_undefined(const pddl::Problem& problem, const Symbols& symbols, const GroundModel& model,
                       const std::vector<UndefinedNumber>& undefined, std::vector<std::string>& warnings) {
  std::size_t more = 0;
  for (const UndefinedNumber& one : undefined) {
    if (one.assigned) continue;
    if (warnings.size() >= kMostWarnings) {
      ++more;
      continue;
    }
    const FunctionId function(std::size_t{model.numbers.symbol(one.number.value)});
    const auto objects = model.numbers.objects(one.number.value);
    warnings.push_back(warning(problem, lacks_value(text(symbols[function].name, objects, symbols))));
  }
  if (more > 0) warnings.push_back(warning(problem, "so have " + std::to_string(more) + " more"));
}

// Where there is no plan: constants that some action asked for in vain. That a table has gaps is nothing to
// speak of otherwise.
void warn_of_gaps(const pddl::Problem& problem, const Symbols& symbols, const ConstantFunctions& constants,
                  std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < symbols.functions(); ++i) {
    if (const auto& objects = constants.missed(FunctionId(i)))
      warnings.push_back(warning(problem, lacks_value(text(symbols[FunctionId(i)].name, *objects, symbols))));
  }
}

}  // namespace

Grounding ground(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
                 const Options& options, SearchLimits& limits, GroundingReport& report) {
  Symbols symbols(domain, problem);
  const std::vector<LiftedAction> actions = lower_actions(domain, symbols);
  ConstantFunctions constants(problem, actions, symbols);
  constants.load_external(
      functions, [&] { return limits.cancelled(); }, symbols,
      report.keeps_functions ? &report.functions : nullptr);
  const StaticModel static_model(problem, actions, symbols, constants);

  GroundModel model =
      instantiate(domain, problem, actions, static_model, explore(actions, static_model, limits), limits);
  drop_self_defeating(model);
  report.shorter_than_separation += drop_undoing_too_soon(model, options.epsilon);
  warn_of_undefined(problem, symbols, model, require_values(model, symbols), report.warnings);
  extract_timed_windows(model, options.windows, options.epsilon);
  split_envelopes_by_duration(model, symbols);
  const Disjunction goal = model.goal;
  while (true) {
    const std::vector<bool> reached = prune(model, limits);
    if (model.goal.empty()) {
      warn_of_gaps(problem, symbols, constants, report.warnings);
      refuse({problem, actions, static_model, symbols, model, goal, reached, options.epsilon});
    }
    settle_read_sets(model);
    drop_irrelevant_effects(model);
    const auto groups = find_mutex_groups(model, reached, symbols.predicates(), actions.size(), limits);
    std::vector<Compression> compression(model.actions.size());
    if (options.compression_safety) compression = find_compression(model, groups, limits);
    Task task = build_task(model, symbols, actions, groups, compression, limits);
    const std::size_t dropped = drop_shorter_than_separation(model, task, options.epsilon);
    report.shorter_than_separation += dropped;
    if (dropped > 0) continue;
    return {std::move(symbols), std::move(constants), std::move(task)};
  }
}

}  // namespace roci::planner::temporal_pddl::grounding
