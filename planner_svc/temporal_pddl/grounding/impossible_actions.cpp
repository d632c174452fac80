#include "planner_svc/temporal_pddl/grounding/impossible_actions.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "planner_svc/temporal_pddl/constraints/orderings.hpp"

namespace roci::planner::temporal_pddl::grounding {

using constraints::Orderings, constraints::StepConstraint;
using instantiation::GroundAction, instantiation::GroundLiteral, instantiation::GroundModel,
    instantiation::ImpossibleAction;
using task::Action, task::ActionId, task::Task;
using temporal::Duration;

namespace {

std::optional<GroundLiteral> broken_by_own_start(const GroundModel& model, const GroundAction& action) {
  if (!action.durative) return std::nullopt;
  for (const GroundLiteral literal : action.over_all.literals) {
    const auto& against = literal.negated ? action.start_effects.adds : action.start_effects.deletes;
    if (!model.derived[literal.atom] && std::ranges::binary_search(against, literal.atom)) return literal;
  }
  return std::nullopt;
}

// Of ascending atoms.
bool intersect(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end(); *i < *j ? ++i : ++j)
    if (*i == *j) return true;
  return false;
}

ImpossibleAction note_of(const GroundAction& action) {
  ImpossibleAction note{action.schema,
                        {action.arguments.begin(), action.arguments.end()},
                        {action.start_effects.adds.begin(), action.start_effects.adds.end()},
                        {},
                        action.max_duration};
  const auto& adds = action.end_effects.adds;
  note.adds.insert(note.adds.end(), adds.begin(), adds.end());
  return note;
}

}  // namespace

void drop_self_defeating(GroundModel& model) {
  std::erase_if(model.actions, [&](const GroundAction& action) {
    const auto broken = broken_by_own_start(model, action);
    if (!broken) return false;
    model.impossible_actions.push_back(note_of(action));
    model.impossible_actions.back().broken = broken;
    return true;
  });
}

std::size_t drop_undoing_too_soon(GroundModel& model, Duration epsilon) {
  return std::erase_if(model.actions, [&](const GroundAction& action) {
    if (!action.durative || action.max_duration >= epsilon) return false;
    const auto &start = action.start_effects, &end = action.end_effects;
    if (!intersect(start.deletes, end.adds) && !intersect(start.adds, end.deletes)) return false;
    model.impossible_actions.push_back(note_of(action));
    return true;
  });
}

std::size_t drop_shorter_than_separation(GroundModel& model, const Task& task, Duration epsilon) {
  std::optional<Orderings> orderings;
  std::vector<bool> dropped;
  for (std::size_t i = 0; i < task.actions.size(); ++i) {
    const Action& action = task.actions[ActionId(i)];
    if (action.instantaneous() || action.max_duration >= epsilon) continue;
    if (!orderings) orderings.emplace(task, epsilon);
    std::vector<StepConstraint> apart;
    orderings->add(std::array{action.start}, action.end, {}, apart);
    if (std::ranges::none_of(apart,
                             [&](const StepConstraint& one) { return one.lower > action.max_duration; }))
      continue;
    dropped.resize(task.actions.size(), false);
    dropped[i] = true;
    model.impossible_actions.push_back(note_of(model.actions[i]));
  }
  if (dropped.empty()) return 0;
  std::size_t i = 0;
  return std::erase_if(model.actions, [&](const GroundAction&) { return dropped[i++]; });
}

}  // namespace roci::planner::temporal_pddl::grounding
