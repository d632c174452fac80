// What four strategies of planning and execution are expected to bring home (MEXEC, sections II.C, III.D and V.A,
// equations 1–5, R103–R106). All utilities are sums over what has arrived; a plan's tasks fail independently of each
// other with one probability (Z16).
#pragma once

#include <span>

namespace roci::planner::utility_htn::strategies {

/// Splits the probability that one attempt of a task fails by the cheapest mechanism that can resolve the failure. All
/// four are joint probabilities of one attempt, not conditional on failure (Z5: section II.C gives conditional ones,
/// section V.A joint ones, and equations 2–5 need the joint ones).
struct FailureProbabilities {
  double fail = 0;        ///< P(fail)
  double flexible = 0;    ///< P(FE)
  double replanning = 0;  ///< P(Replan)
  double ground = 0;      ///< P(Ground)
};

/// Equation 1, which is lost in the paper (Z6), read as P(fail) = P(FE) + P(Replan) + P(Ground): flexible execution
/// resolves a share of all failures, replanning a share of the others, the ground the rest, so that none stays. All
/// arguments lie within [0, 1]; otherwise std::invalid_argument is thrown (R106: 0.1, 0.3,
/// 0.6 gives 0.03, 0.042, 0.028).
FailureProbabilities split(double fail, double flexible_share, double replanning_share_of_rest);

/// Returns the probability that a failure is resolved so, given that there is one (section II.C): the joint one over
/// P(fail), 0 without failures.
double given_failure(double joint, const FailureProbabilities& probabilities);

/// Returns u_avg = Σu / Σc over the tasks of a plan. The paper prints Σ(u / c), by which b · u_avg would not be the
/// utility of a plan that costs b and never fails (Z16). Throws std::invalid_argument when nothing costs anything or
/// the lists differ in length.
double utility_per_cost(std::span<const double> utilities, std::span<const double> costs);

/// Describes a plan that was made without failures in mind.
struct PlanFigures {
  double budget = 0;            ///< b
  double tasks = 0;             ///< n
  double utility_per_cost = 0;  ///< u_avg
  double cost_per_task = 0;     ///< c_avg
};

/// Says what resolving one failure takes from the budget; flexible execution is free.
struct RecoveryCosts {
  double ground = 0;      ///< c_g
  double replanning = 0;  ///< c_r
};

/// Describes utility that is found on the way, of which only replanning can make use.
struct Discoveries {
  double count = 0;  ///< d: at most so many, since each needs a task's energy (Z16); see most_discoveries()
  double utility_each = 0;  ///< u_d
};

/// Returns the expected number of tasks that succeed before the first failure, (1 - P) / P: 9 for P = 0.1.
double successes_before_failure(double fail);

/// Equation 2: the first failure ends the plan.
double static_utility(const PlanFigures& plan, const FailureProbabilities& probabilities);
/// Equation 3: the ground resolves every failure.
double ground_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                      const RecoveryCosts& costs);
/// Equation 4: flexible execution resolves what it can for nothing, the ground the rest.
double flexible_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                        const RecoveryCosts& costs);
/// Equation 5: flexible execution, then replanning, then the ground; and discoveries are used.
double replanning_utility(const PlanFigures& plan, const FailureProbabilities& probabilities,
                          const RecoveryCosts& costs, const Discoveries& discoveries);

/// Returns the upper bound of d of section V.A: how often a task with an opportunity to discover can be paid for.
double most_discoveries(double budget, double cost_each);

/// Returns the same plan cut off where so much of its budget is spent, for curves of utility over energy.
PlanFigures until_spent(const PlanFigures& plan, double spent);

/// Returns how many tasks b really pays for when every failure costs `recovery_per_task` on the average: b / (c_avg +
/// that). With it in the place of n, equations 3–5 are exact for a long plan;
/// with the planned b / c_avg they are a little too low.
double tasks_paid_for(const PlanFigures& plan, double recovery_per_task);

}  // namespace roci::planner::utility_htn::strategies
