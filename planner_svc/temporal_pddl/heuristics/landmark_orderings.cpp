#include "planner_svc/temporal_pddl/heuristics/landmark_orderings.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::heuristics {

using task::ActionId, task::FactId, task::Id, task::IdVector, task::SnapId, task::SnapKind, task::Task;

LandmarkOrderings::LandmarkOrderings(const Task& task, const RelaxedTask& relaxed,
                                     const IdVector<LandmarkId, Landmark>& landmarks)
    : task_(task),
      relaxed_(relaxed),
      landmarks_(landmarks),
      rows_(landmarks.size()),
      columns_(landmarks.size()),
      right_before_(landmarks.size()),
      variable_(task.fact_names.size(), Id<struct VariableTag>::kNone) {
  const auto variables = task.layout.variables();
  for (std::uint32_t i = 0; i < variables.size(); ++i) {
    for (const FactId fact : variables[i].facts) variable_[fact] = i;
  }
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    for (const LandmarkId later : landmarks[LandmarkId(i)].needed_by)
      right_before_[later].push_back(LandmarkId(i));
  }
}

void LandmarkOrderings::add(LandmarkId earlier, LandmarkId later) {
  const std::size_t a = earlier.index(), b = later.index();
  if (a == b || rows_.get(a, b) || rows_.get(b, a)) return;
  earlier_.assign(1, a);
  columns_.each_beside(a, columns_.row(b), [&](std::size_t i) { earlier_.push_back(i); });
  later_.assign(1, b);
  rows_.each_beside(b, rows_.row(a), [&](std::size_t j) { later_.push_back(j); });
  // The row of b and the column of a stay as they are: nothing that comes before a comes after b.
  for (const std::size_t i : earlier_) rows_.add(i, rows_.row(b), b);
  for (const std::size_t j : later_) columns_.add(j, columns_.row(a), a);
}

void LandmarkOrderings::add_reasonable() {
  const Bits known = rows_;
  const auto consider = [&](LandmarkId held, LandmarkId wanted) {
    if (held != wanted && !rows_.get(held.index(), wanted.index()) && undone_for(held, wanted))
      add(wanted, held);
  };
  const auto each = [&](const auto& visit) {
    for (std::size_t i = 0; i < landmarks_.size(); ++i) visit(LandmarkId(i));
  };
  each([&](LandmarkId a) {
    each([&](LandmarkId b) {
      if (landmarks_[a].goal && landmarks_[b].goal) consider(b, a);
    });
  });
  each([&](LandmarkId common) {
    for (const LandmarkId held : right_before_[common]) {
      each([&](LandmarkId wanted) {
        if (known.get(wanted.index(), common.index())) consider(held, wanted);
      });
    }
  });
}

std::vector<LandmarkId> LandmarkOrderings::just_before(LandmarkId later) const {
  std::vector<LandmarkId> result;
  const std::vector<std::uint64_t> none(columns_.words(), 0);
  columns_.each_beside(later.index(), none.data(), [&](std::size_t i) {
    if (!rows_.meets(i, columns_.row(later.index()))) result.push_back(LandmarkId(i));
  });
  return result;
}

bool LandmarkOrderings::undone_for(LandmarkId held, LandmarkId wanted) const {
  if (landmarks_[held].any_of.size() > 1 || landmarks_[wanted].any_of.size() > 1) return false;
  const PropositionId b = landmarks_[held].any_of.front();
  const PropositionId a = landmarks_[wanted].any_of.front();
  if (mutex(a, b)) return true;
  const auto& needed = right_before_[wanted];
  if (std::ranges::any_of(needed, [&](LandmarkId id) {
        return id != held && landmarks_[id].any_of.size() == 1 && mutex(landmarks_[id].any_of.front(), b);
      }))
    return true;
  const auto& achievers = landmarks_[wanted].achievers;
  return !achievers.empty() && std::ranges::all_of(achievers, [&](SnapId op) { return undoes(op, b); });
}

bool LandmarkOrderings::mutex(PropositionId a, PropositionId b) const {
  if (a == b || a.index() >= variable_.size() || b.index() >= variable_.size()) return false;
  const std::uint32_t variable = variable_[FactId(a.index())];
  return variable != Id<struct VariableTag>::kNone && variable == variable_[FactId(b.index())];
}

// Returns whether the start or end of the operator's action takes the fact away and does not give it back.
bool LandmarkOrderings::undoes(SnapId op, PropositionId held) const {
  if (held.index() >= variable_.size()) return false;
  const FactId fact(held.index());
  bool undone = false;
  const auto take = [&](SnapId step) {
    if (std::ranges::count(task_.deletes[step], fact) > 0) undone = true;
    for (const FactId added : task_.adds[step]) {
      if (added == fact) undone = false;
      if (mutex(PropositionId(added.index()), held)) undone = true;
    }
  };
  take(op);
  const ActionId action = task_.snaps[op].action;
  if (task_.snaps[op].kind == SnapKind::start) take(task_.actions[action].end);
  return undone;
}

}  // namespace roci::planner::temporal_pddl::heuristics
