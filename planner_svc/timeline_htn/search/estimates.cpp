#include <algorithm>

#include "planner_svc/timeline_htn/search/decompositions.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

using model::StateKind;

namespace {

class Blind : public Estimate {
 public:
  std::uint32_t of(const PartialPlan&) override { return 0; }
};

/// Counts the values of a plan for what is open in which conditions, needs, transitions and times are left out.
class RelaxedPlan : public Estimate {
 public:
  RelaxedPlan(Ground& ground, const Successors& successors) : ground_(&ground), below_(ground, successors) {}

  std::uint32_t of(const PartialPlan& plan) override {
    std::uint64_t sum = 0;
    const auto add = [&](StateId state, std::uint32_t itself) {
      if (state == kNone || ground_->at(state).kind != StateKind::complex) {
        sum += itself;
        return true;
      }
      const std::uint32_t values = below_.values(state);
      sum += values;
      return values != kNone;
    };
    for (const Index activity : plan.open())
      if (!add(plan.activities()[activity].state, 1)) return kNone;
    for (const Urgent* item = plan.urgent(); item != nullptr; item = plan.below(*item)) {
      const bool decompose = item->kind == UrgentKind::decompose;
      if (!add(decompose ? plan.activities()[item->subject].state : kNone, 1)) return kNone;
    }
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(sum, kNone - 1));
  }

 private:
  Ground* ground_;
  Decompositions below_;
};

/// Counts the states without which what is open cannot come about.
class LandmarkCount : public Estimate {
 public:
  LandmarkCount(Ground& ground, const Successors& successors)
      : ground_(&ground), below_(ground, successors) {}

  std::uint32_t of(const PartialPlan& plan) override {
    landmarks_.clear();
    std::uint32_t others = 0;
    const auto add = [&](StateId state) {
      if (state == kNone) {
        ++others;
      } else if (ground_->at(state).kind != StateKind::complex) {
        landmarks_.push_back(state);
      } else {
        const auto& all = below_.landmarks(state);
        landmarks_.insert(landmarks_.end(), all.begin(), all.end());
        return !all.empty();
      }
      return true;
    };
    for (const Index activity : plan.open())
      if (!add(plan.activities()[activity].state)) return kNone;
    for (const Urgent* item = plan.urgent(); item != nullptr; item = plan.below(*item)) {
      const bool decompose = item->kind == UrgentKind::decompose;
      if (!add(decompose ? plan.activities()[item->subject].state : kNone)) return kNone;
    }
    std::ranges::sort(landmarks_);
    return others + static_cast<std::uint32_t>(landmarks_.size() - std::ranges::unique(landmarks_).size());
  }

 private:
  Ground* ground_;
  Decompositions below_;
  std::vector<StateId> landmarks_;
};

}  // namespace

std::unique_ptr<Estimate> make_estimate(Heuristic heuristic, Ground& ground, const Successors& successors) {
  switch (heuristic) {
    case Heuristic::relaxed_plan:
      return std::make_unique<RelaxedPlan>(ground, successors);
    case Heuristic::landmarks:
      return std::make_unique<LandmarkCount>(ground, successors);
    default:
      return std::make_unique<Blind>();
  }
}

}  // namespace roci::planner::timeline_htn::search
