#include "planner_svc/temporal_pddl/grounding/unreachable_goal.hpp"

#include <algorithm>
#include <utility>

#include "core/pddl/printer.hpp"
#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/grounding/fact_patterns.hpp"
#include "planner_svc/temporal_pddl/grounding/goal_causes.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"

namespace roci::planner::temporal_pddl::grounding {

using call::BlockedFact, call::PlanningFailure;
using instantiation::WindowMisfit;
using simplification::literal_index;
using temporal::Verdict;

namespace {

// Names, of the actions that are longer than their windows and would bring about what nothing else does, the
// one that lacks least; the text is empty if there is none.
std::string window_too_short(const UnreachableGoal& known) {
  const WindowMisfit* nearest = nullptr;
  for (const WindowMisfit& note : known.model.window_misfits) {
    const bool missed = std::ranges::any_of(note.adds, [&](std::uint32_t atom) {
      return !known.reached[literal_index({atom, false})];
    });
    const auto lack = [](const WindowMisfit& action) { return action.duration - action.window; };
    if (missed && (!nearest || lack(note) < lack(*nearest))) nearest = &note;
  }
  if (!nearest) return {};
  const std::string name =
      Patterns(known).text(known.actions[nearest->schema.index()].name, nearest->arguments);
  return name + " takes " + in_seconds(nearest->duration) + ", its longest window is " +
         in_seconds(nearest->window) + ": " + in_seconds(nearest->duration - nearest->window) + " too short";
}

}  // namespace

void refuse(const UnreachableGoal& known) {
  const Patterns patterns(known);
  std::vector<std::string> facts = known.model.unreachable_goals;
  for (const auto& goal : known.goal) {
    for (const auto literal : goal.literals) {
      if (!known.reached[literal_index(literal)]) facts.push_back(patterns.text(patterns.of(literal)));
    }
  }
  std::string text;
  for (const std::string& fact : facts) text += " " + fact;
  if (facts.empty()) {
    text = " " + pddl::print(known.problem.goal);
    std::vector<const pddl::Condition*> parts;
    collect_parts(known.problem.goal, parts);
    for (const pddl::Condition* part : parts) facts.push_back(pddl::print(*part));
  }
  std::string causes;
  for (const std::string& cause : causes_of(known)) causes += cause + "; ";
  const std::string misfit = window_too_short(known);
  std::vector<BlockedFact> blocked;
  for (std::string& fact : facts) blocked.push_back({std::move(fact), misfit});
  throw PlanningFailure(
      Verdict::unsolvable,
      causes +
          "no sequence of actions reaches, even if nothing were ever deleted and numbers did not count:" +
          text + (misfit.empty() ? "" : "; " + misfit),
      std::move(blocked));
}

}  // namespace roci::planner::temporal_pddl::grounding
