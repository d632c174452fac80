#include "planner_svc/utility_htn/strategies/equations.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace roci::planner::utility_htn::strategies {
namespace {

double left(const PlanFigures& plan, double recovery_per_task) {
  return plan.utility_per_cost * (plan.budget - plan.tasks * recovery_per_task);
}

}  // namespace

FailureProbabilities split(double fail, double flexible_share, double replanning_share_of_rest) {
  for (const double share : {fail, flexible_share, replanning_share_of_rest}) {
    if (!(share >= 0 && share <= 1))
      throw std::invalid_argument("a probability or share lies outside of [0, 1]");
  }
  FailureProbabilities out{.fail = fail, .flexible = fail * flexible_share};
  out.replanning = (fail - out.flexible) * replanning_share_of_rest;
  out.ground = fail - out.flexible - out.replanning;
  return out;
}

double given_failure(double joint, const FailureProbabilities& probabilities) {
  return probabilities.fail > 0 ? joint / probabilities.fail : 0;
}

double utility_per_cost(std::span<const double> utilities, std::span<const double> costs) {
  if (utilities.size() != costs.size()) throw std::invalid_argument("each task has one utility and one cost");
  const double cost = std::accumulate(costs.begin(), costs.end(), 0.0);
  if (!(cost > 0)) throw std::invalid_argument("no task of the plan costs anything");
  return std::accumulate(utilities.begin(), utilities.end(), 0.0) / cost;
}

double successes_before_failure(double fail) {
  return fail > 0 ? (1 - fail) / fail : std::numeric_limits<double>::infinity();
}

double static_utility(const PlanFigures& plan, const FailureProbabilities& probabilities) {
  const double without_failure = plan.utility_per_cost * plan.budget;
  const double per_task = plan.utility_per_cost * plan.cost_per_task;
  if (per_task == 0) return 0;
  return std::min(without_failure, per_task * successes_before_failure(probabilities.fail));
}

double ground_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                      const RecoveryCosts& costs) {
  return left(plan, probabilities.fail * costs.ground);
}

double flexible_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                        const RecoveryCosts& costs) {
  return left(plan, (probabilities.fail - probabilities.flexible) * costs.ground);
}

double replanning_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                          const RecoveryCosts& costs, const Discoveries& discoveries) {
  return discoveries.count * discoveries.utility_each +
         left(plan, probabilities.ground * costs.ground + probabilities.replanning * costs.replanning);
}

double most_discoveries(double budget, double cost_each) {
  if (!(cost_each > 0)) throw std::invalid_argument("a task that can discover something costs something");
  return std::max(0.0, budget / cost_each);
}

PlanFigures until_spent(const PlanFigures& plan, double spent) {
  PlanFigures out = plan;
  out.budget = std::clamp(spent, 0.0, plan.budget);
  out.tasks = plan.budget > 0 ? plan.tasks * out.budget / plan.budget : 0;
  return out;
}

double tasks_paid_for(const PlanFigures& plan, double recovery_per_task) {
  return plan.budget / (plan.cost_per_task + recovery_per_task);
}

}  // namespace roci::planner::utility_htn::strategies
