#include "planner_svc/temporal_pddl/heuristics/landmark_count.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::heuristics {

using call::SearchLimits;
using task::ActionId, task::FactId, task::SnapId, task::Task;

namespace {

// Landmarks are looked for with at most so many visits of operators, which keeps the search short.
constexpr std::size_t kMostVisits = 20'000'000;

}  // namespace

LandmarkCount::LandmarkCount(const Task& task, FfHeuristic& ff, const SearchLimits& limits)
    : task_(task), ff_(ff) {
  Estimate estimate;
  ff.evaluate({task.initial_state, {}, 0, nullptr, {}, {}}, estimate);
  if (!estimate.dead_end)
    landmarks_ = find_landmarks(task, ff.relaxed(), ff.relaxed_plan(), kMostVisits, limits);
  std::vector<std::vector<LandmarkId>> of(ff.relaxed().propositions());
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    for (const PropositionId proposition : landmarks_[LandmarkId(i)].any_of)
      of[proposition.index()].push_back(LandmarkId(i));
  }
  for (const auto& list : of) of_.push_back(list);
  reached_at_first_.assign(landmarks_.size(), false);
  reached_ = reached_at_first_;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[LandmarkId(i)];
    reached_at_first_[LandmarkId(i)] = landmark.initially && landmark.after.empty();
  }
}

void LandmarkCount::evaluate(const EvaluationContext& context, Estimate& estimate) {
  ff_.evaluate(context, estimate);
  if (estimate.dead_end) return;
  follow(context);
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[LandmarkId(i)];
    if (!reached_[LandmarkId(i)]) {
      ++estimate.landmarks;
      if (!all_reached(landmark.after)) continue;
      estimate.preferred.insert(estimate.preferred.end(), landmark.achievers.begin(),
                                landmark.achievers.end());
    } else if ((landmark.goal || !all_reached(landmark.needed_by)) && !holds(landmark, context)) {
      ++estimate.landmarks;
    }
  }
}

// A landmark counts as reached if it was true at a time when all that come before it had been reached.
void LandmarkCount::follow(const EvaluationContext& context) {
  reached_ = reached_at_first_;
  const auto reach = [&](LandmarkId id) {
    if (!reached_[id] && all_reached(landmarks_[id].after)) reached_[id] = true;
  };
  for (const SnapId step : context.steps) {
    for (const PropositionId added : ff_.relaxed().adds(step)) std::ranges::for_each(of_[added], reach);
  }
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (!reached_[LandmarkId(i)] && holds(landmarks_[LandmarkId(i)], context)) reach(LandmarkId(i));
  }
}

bool LandmarkCount::all_reached(const std::vector<LandmarkId>& landmarks) const {
  return std::ranges::all_of(landmarks, [&](LandmarkId id) { return reached_[id]; });
}

bool LandmarkCount::holds(const Landmark& landmark, const EvaluationContext& context) const {
  const std::size_t facts = task_.fact_names.size();
  return std::ranges::any_of(landmark.any_of, [&](PropositionId proposition) {
    if (proposition.index() < facts) return task_.layout.holds(context.state, FactId(proposition.index()));
    return std::ranges::count(context.running, ActionId(proposition.index() - facts)) > 0;
  });
}

}  // namespace roci::planner::temporal_pddl::heuristics
