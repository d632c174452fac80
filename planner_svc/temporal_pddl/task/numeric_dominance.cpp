#include "planner_svc/temporal_pddl/task/numeric_dominance.hpp"

namespace roci::planner::temporal_pddl::task {

namespace {

NumericDominance opposite(NumericDominance preference) {
  if (preference == NumericDominance::higher) return NumericDominance::lower;
  return preference == NumericDominance::lower ? NumericDominance::higher : preference;
}

class Analysis {
 public:
  Analysis(const Task& task, bool metric_counts)
      : task_(task), metric_counts_(metric_counts), result_(task.layout.numbers(), NumericDominance::none) {}

  IdVector<NumberId, NumericDominance> run() {
    for (std::size_t snap = 0; snap < task_.snaps.size(); ++snap) use(task_.comparisons[snap]);
    for (std::size_t rule = 0; rule < task_.derived.rules(); ++rule) {
      for (const NumericCondition& condition : task_.derived.comparisons(rule))
        use(condition.expression, NumericDominance::exact);
    }
    for (std::size_t action = 0; action < task_.actions.size(); ++action) {
      use(task_.numeric_invariants[action]);
      for (const DurationRule& rule : task_.duration_rules[action]) use(rule.bound, NumericDominance::exact);
    }
    for (const Goal& goal : task_.goals) use(goal.comparisons);
    if (metric_counts_) use(task_.metric.expression, NumericDominance::lower);
    for (changed_ = true; changed_;) {
      changed_ = false;
      for (std::size_t snap = 0; snap < task_.snaps.size(); ++snap) {
        for (const NumericEffect& effect : task_.numeric_effects[snap]) {
          use(effect.expression, result_[effect.variable]);
        }
      }
    }
    return std::move(result_);
  }

 private:
  void use(std::span<const NumericCondition> conditions) {
    for (const NumericCondition& condition : conditions) {
      use(condition.expression,
          condition.comparator == Comparator::equal ? NumericDominance::exact : NumericDominance::higher);
    }
  }

  void use(ExpressionId expression, NumericDominance wanted) { use(task_.expressions[expression], wanted); }

  void use(const LinearExpression& expression, NumericDominance wanted) {
    if (wanted == NumericDominance::none) return;
    for (const auto& term : expression.terms) {
      const NumericDominance here = term.weight > 0 ? wanted : opposite(wanted);
      NumericDominance& known = result_[term.variable];
      const NumericDominance both =
          known == NumericDominance::none || known == here ? here : NumericDominance::exact;
      changed_ = changed_ || both != known;
      known = both;
    }
  }

  const Task& task_;
  bool metric_counts_;
  IdVector<NumberId, NumericDominance> result_;
  bool changed_ = false;
};

}  // namespace

IdVector<NumberId, NumericDominance> numeric_dominance(const Task& task, bool metric_counts) {
  return Analysis(task, metric_counts).run();
}

}  // namespace roci::planner::temporal_pddl::task
