#include "planner_svc/temporal_pddl/task/consumable_resources.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace roci::planner::temporal_pddl::task {

using temporal::Duration;
using temporal::no_bound;

namespace {

constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

// Is the amount constant + slope · ?duration.
struct Amount {
  double constant = 0;
  double slope = 0;
};

class Candidate {
 public:
  Candidate(const Task& task, NumberId number, double sign) : task_(task), number_(number), sign_(sign) {}

  std::optional<ConsumableResource> judge() const {
    ConsumableResource result{number_, sign_, std::numeric_limits<double>::infinity(), {}};
    for (std::size_t i = 0; i < task_.snaps.size(); ++i) {
      const SnapId snap(i);
      const auto amount = taken_by(snap);
      const bool timed = task_.snaps[snap].kind == SnapKind::timed_literal;
      if (!amount || least(*amount, snap) < 0) return std::nullopt;
      result.taken.push_back(least(*amount, snap));
      if (amount->constant == 0 && amount->slope == 0) continue;
      if (timed) return std::nullopt;
      result.floor = std::min(result.floor, floor_after(snap, *amount));
    }
    double goals = std::numeric_limits<double>::infinity();
    for (const Goal& goal : task_.goals) goals = std::min(goals, floor_of(goal.comparisons, {}, SnapId()));
    if (!task_.goals.empty()) result.floor = std::max(result.floor, goals);
    if (!std::isfinite(result.floor)) return std::nullopt;
    return result;
  }

 private:
  // Returns what the step takes of the number, or nothing if it sets the number or takes what depends on
  // other numbers.
  std::optional<Amount> taken_by(SnapId snap) const {
    Amount result;
    for (const NumericEffect& effect : task_.numeric_effects[snap]) {
      if (effect.variable != number_) continue;
      const LinearExpression& change = task_.expressions[effect.expression];
      if (effect.assigns || !change.terms.empty()) return std::nullopt;
      result.constant -= sign_ * change.constant;
      result.slope -= sign_ * change.duration_weight;
    }
    return result;
  }

  double least(const Amount& amount, SnapId snap) const {
    if (amount.slope == 0) return amount.constant;
    const Action& action = task_.actions[task_.snaps[snap].action];
    const Duration at = amount.slope > 0 ? action.min_duration : action.max_duration;
    if (at == no_bound) return kNoFloor;
    return amount.constant + amount.slope * std::chrono::duration<double>(at).count();
  }

  double floor_after(SnapId id, const Amount& amount) const {
    const Snap& snap = task_.snaps[id];
    double result = floor_of(task_.comparisons[id], amount, id);
    if (snap.kind == SnapKind::end)
      result = std::max(result, floor_of(task_.numeric_invariants[snap.action], amount, id));
    return result;
  }

  // Returns the least value that the strongest of the conditions leaves after `amount` is taken.
  double floor_of(std::span<const NumericCondition> conditions, const Amount& amount, SnapId snap) const {
    double result = kNoFloor;
    for (const NumericCondition& condition : conditions) {
      const LinearExpression& expression = task_.expressions[condition.expression];
      if (expression.terms.size() != 1 || expression.terms.front().variable != number_) continue;
      const double weight = expression.terms.front().weight * sign_;
      if (weight < 0 && condition.comparator != Comparator::equal) continue;
      const Amount after{-expression.constant / weight - amount.constant,
                         -expression.duration_weight / weight - amount.slope};
      result = std::max(result, snap.is_none() ? after.constant : least(after, snap));
    }
    return result;
  }

  const Task& task_;
  NumberId number_;
  double sign_;
};

}  // namespace

std::vector<ConsumableResource> find_consumable_resources(const Task& task) {
  std::vector<ConsumableResource> result;
  for (std::size_t i = 0; i < task.layout.numbers(); ++i) {
    if (std::isnan(task.layout.numbers(task.initial_state)[NumberId(i)])) continue;
    for (const double sign : {1.0, -1.0}) {
      auto resource = Candidate(task, NumberId(i), sign).judge();
      if (resource) result.push_back(std::move(*resource));
    }
  }
  return result;
}

}  // namespace roci::planner::temporal_pddl::task
