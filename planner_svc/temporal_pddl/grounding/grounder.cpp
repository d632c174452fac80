#include "planner_svc/temporal_pddl/grounding/grounder.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/grounding/encoding/task_builder.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/instantiate.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/compression_safety.hpp"
#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/constant_functions.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/static_model.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/symbols.hpp"
#include "planner_svc/temporal_pddl/grounding/reachability/reachability.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/envelopes.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/read_sets.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relevance.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/timed_windows.hpp"

namespace roci::planner::temporal_pddl::grounding {

using call::BlockedFact, call::Options, call::PlanningFailure, call::SearchLimits;
using encoding::build_task;
using engine::FunctionSource, engine::FunctionUse;
using instantiation::Disjunction, instantiation::GroundLiteral, instantiation::GroundModel,
    instantiation::WindowMisfit, instantiation::instantiate;
using invariants::Compression, invariants::find_compression, invariants::find_mutex_groups;
using lifted::ConstantFunctions, lifted::LiftedAction, lifted::StaticModel, lifted::Symbols,
    lifted::lower_actions;
using reachability::explore;
using simplification::drop_irrelevant_effects, simplification::extract_timed_windows,
    simplification::literal_index, simplification::prune, simplification::settle_read_sets,
    simplification::split_envelopes_by_duration;
using task::ObjectId, task::PredicateId, task::Task;
using temporal::Duration, temporal::Verdict;

namespace {

std::string literal_text(const GroundModel& model, const Symbols& symbols, GroundLiteral literal) {
  std::string text = "(" + symbols.name(PredicateId(std::size_t{model.atoms.symbol(literal.atom)}));
  for (const ObjectId object : model.atoms.objects(literal.atom)) text += " " + symbols.name(object);
  text += ")";
  return literal.negated ? "(not " + text + ")" : text;
}

std::string seconds(Duration duration) {
  const std::string text = std::to_string(std::chrono::duration<double>(duration).count());
  return text.substr(0, text.size() - 3) + " s";
}

// Names, of the actions that are longer than their windows and would bring about what nothing else does, the
// one that lacks least; the text is empty if there is none.
std::string window_too_short(const GroundModel& model, const std::vector<bool>& reached,
                             const Symbols& symbols, const std::vector<LiftedAction>& actions) {
  const WindowMisfit* nearest = nullptr;
  for (const WindowMisfit& note : model.window_misfits) {
    const bool missed = std::ranges::any_of(note.adds, [&](std::uint32_t atom) {
      return !reached[literal_index({atom, false})];
    });
    const auto lack = [](const WindowMisfit& action) { return action.duration - action.window; };
    if (missed && (!nearest || lack(note) < lack(*nearest))) nearest = &note;
  }
  if (!nearest) return {};
  std::string name = "(" + actions[nearest->schema.index()].name;
  for (const ObjectId object : nearest->arguments) name += " " + symbols.name(object);
  return "; " + name + ") takes " + seconds(nearest->duration) + ", its longest window is " +
         seconds(nearest->window) + ": " + seconds(nearest->duration - nearest->window) + " too short";
}

// The parts of a conjunction as text.
std::vector<std::string> parts_of(const pddl::Condition& condition) {
  const auto* conjunction = std::get_if<pddl::And>(&condition.node);
  if (conjunction == nullptr) return {pddl::print(condition)};
  std::vector<std::string> parts;
  for (const pddl::Condition& part : conjunction->parts)
    std::ranges::copy(parts_of(part), std::back_inserter(parts));
  return parts;
}

// Throws if no alternative of the goal survives pruning, naming what stands in the way.
void require_reachable_goal(const pddl::Problem& problem, const Disjunction& before, const GroundModel& model,
                            const std::vector<bool>& reached, const Symbols& symbols,
                            const std::vector<LiftedAction>& actions) {
  if (!model.goal.empty()) return;
  std::vector<std::string> facts = model.unreachable_goals;
  for (const auto& goal : before) {
    for (const auto literal : goal.literals) {
      if (!reached[literal_index(literal)]) facts.push_back(literal_text(model, symbols, literal));
    }
  }
  std::string text;
  for (const std::string& fact : facts) text += " " + fact;
  if (facts.empty()) {
    text = " " + pddl::print(problem.goal);
    facts = parts_of(problem.goal);
  }
  const std::string misfit = window_too_short(model, reached, symbols, actions);
  std::vector<BlockedFact> blocked;
  for (std::string& fact : facts)
    blocked.push_back({std::move(fact), "no sequence of actions reaches it" + misfit});
  throw PlanningFailure(
      Verdict::unsolvable,
      "no sequence of actions reaches, even if nothing were ever deleted and numbers did not count:" + text +
          misfit,
      std::move(blocked));
}

}  // namespace

Grounding ground(const pddl::Domain& domain, const pddl::Problem& problem, FunctionSource& functions,
                 const Options& options, SearchLimits& limits, std::vector<FunctionUse>& used) {
  Symbols symbols(domain, problem);
  const std::vector<LiftedAction> actions = lower_actions(domain, symbols);
  ConstantFunctions constants(problem, actions, symbols);
  constants.load_external(
      functions, [&] { return limits.cancelled(); }, symbols, used);
  const StaticModel static_model(problem, actions, symbols, constants);

  GroundModel model =
      instantiate(domain, problem, actions, static_model, explore(actions, static_model, limits), limits);
  extract_timed_windows(model, options.windows, options.epsilon);
  split_envelopes_by_duration(model, symbols);
  const Disjunction goal = model.goal;
  const std::vector<bool> reached = prune(model, limits);
  require_reachable_goal(problem, goal, model, reached, symbols, actions);
  settle_read_sets(model);
  drop_irrelevant_effects(model);
  const auto groups = find_mutex_groups(model, reached, symbols.predicates(), actions.size(), limits);
  std::vector<Compression> compression(model.actions.size());
  if (options.compression_safety) compression = find_compression(model, groups, limits);
  Task task = build_task(model, symbols, actions, groups, compression, limits);
  return {std::move(symbols), std::move(constants), std::move(task)};
}

}  // namespace roci::planner::temporal_pddl::grounding
