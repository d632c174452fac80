#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner_svc/timeline_htn/search/decompositions.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

using model::StateKind;

namespace {

class Blind : public Estimate {
 public:
  std::uint32_t of(const PartialPlan&) override { return 0; }
};

/// Finds what has come to be open, and what no longer is, since a plan was looked at last:
/// plans that follow each other differ in little.
class OpenStates {
 public:
  /// Calls these with each state; kNone stands for something urgent that has none.
  template <typename Gone, typename Come>
  void look_at(const PartialPlan& plan, const Gone& gone, const Come& come) {
    now_.clear();
    for (const Index activity : plan.open()) now_.push_back(plan.activities()[activity].state);
    for (const Urgent* item = plan.urgent(); item != nullptr; item = plan.below(*item)) {
      const bool decompose = item->kind == UrgentKind::decompose;
      now_.push_back(decompose ? plan.activities()[item->subject].state : kNone);
    }
    auto [from, to] = std::ranges::mismatch(last_, now_);
    auto last_end = last_.end(), now_end = now_.end();
    for (; last_end != from && now_end != to && *(last_end - 1) == *(now_end - 1); --last_end) --now_end;
    std::for_each(from, last_end, gone);
    std::for_each(to, now_end, come);
    std::swap(last_, now_);
  }

 private:
  std::vector<StateId> last_, now_;
};

/// Counts the values of a plan for what is open in which conditions, needs, transitions and times are left out.
class RelaxedPlan : public Estimate {
 public:
  RelaxedPlan(Ground& ground, Decompositions& below) : ground_(&ground), below_(&below) {}

  std::uint32_t of(const PartialPlan& plan) override {
    const auto count = [&](StateId state, int sign) {
      const bool complex = state != kNone && ground_->at(state).kind == StateKind::complex;
      const std::uint32_t values = complex ? below_->values(state) : 1;
      (values == kNone ? impossible_ : sum_) += sign * (values == kNone ? 1 : std::int64_t{values});
    };
    open_.look_at(
        plan, [&](StateId state) { count(state, -1); }, [&](StateId state) { count(state, 1); });
    return impossible_ > 0 ? kNone : static_cast<std::uint32_t>(std::min<std::int64_t>(sum_, kNone - 1));
  }

 private:
  Ground* ground_;
  Decompositions* below_;
  OpenStates open_;
  std::int64_t sum_ = 0;
  std::int64_t impossible_ = 0;  // states that nothing makes up
};

/// Counts the states without which what is open cannot come about.
class LandmarkCount : public Estimate {
 public:
  LandmarkCount(Ground& ground, Decompositions& below) : ground_(&ground), below_(&below) {}

  std::uint32_t of(const PartialPlan& plan) override {
    const auto count = [&](StateId state, int sign) {
      if (state == kNone) {
        others_ += sign;
      } else if (ground_->at(state).kind != StateKind::complex) {
        count_landmark(state, sign);
      } else {
        const std::vector<StateId>& all = below_->landmarks(state);
        if (all.empty()) impossible_ += sign;
        for (const StateId one : all) count_landmark(one, sign);
      }
    };
    open_.look_at(
        plan, [&](StateId state) { count(state, -1); }, [&](StateId state) { count(state, 1); });
    return impossible_ > 0 ? kNone : static_cast<std::uint32_t>(others_ + different_);
  }

 private:
  void count_landmark(StateId state, int sign) {
    if (state >= times_.size()) times_.resize(state + 1, 0);
    if (sign < 0 && --times_[state] == 0) --different_;
    if (sign > 0 && ++times_[state] == 1) ++different_;
  }

  Ground* ground_;
  Decompositions* below_;
  OpenStates open_;
  std::vector<std::int32_t> times_;  // that something open has the landmark, by state
  std::int64_t different_ = 0;
  std::int64_t others_ = 0;
  std::int64_t impossible_ = 0;
};

}  // namespace

std::unique_ptr<Estimate> make_estimate(Heuristic heuristic, Ground& ground, const Successors& successors) {
  switch (heuristic) {
    case Heuristic::relaxed_plan:
      return std::make_unique<RelaxedPlan>(ground, successors.below());
    case Heuristic::landmarks:
      return std::make_unique<LandmarkCount>(ground, successors.below());
    default:
      return std::make_unique<Blind>();
  }
}

}  // namespace roci::planner::timeline_htn::search
