#include "tests/unit/planner_svc/temporal_pddl/two_accuracies.hpp"

namespace roci::planner::temporal_pddl::testing {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionValue;
using temporal::FunctionAccuracy;

void TwoAccuracies::set(const std::string& application, double value, double bound) {
  FunctionValue& entry = exact[application];
  entry.outcome = FunctionOutcome::value;
  entry.value = value;
  entry.provenance = engine::Provenance{"arm_svc", "", {}};
  bounds[application] = bound;
}

void TwoAccuracies::set(const std::string& application, FunctionOutcome outcome) {
  FunctionValue& entry = exact[application];
  entry.outcome = outcome;
  entry.provenance = engine::Provenance{"arm_svc", "", {}};
  bounds.erase(application);
}

std::vector<FunctionValue> TwoAccuracies::evaluate(std::span<const FunctionCall> asked,
                                                   const std::function<bool()>&) {
  ++batches;
  std::vector<FunctionValue> answers;
  for (const FunctionCall& call : asked) {
    const std::string tuple = application(call);
    const auto bound = bounds.find(tuple);
    if (call.accuracy == FunctionAccuracy::lower_bound && bound != bounds.end()) {
      FunctionValue answer;
      answer.outcome = FunctionOutcome::value;
      answer.value = bound->second;
      answer.provenance = engine::Provenance{"arm_svc", "", {}};
      answer.accuracy = FunctionAccuracy::lower_bound;
      answers.push_back(answer);
      continue;
    }
    asked_again += asked_exactly.insert(tuple).second ? 0 : 1;
    const auto known = exact.find(tuple);
    answers.push_back(known == exact.end() ? FunctionValue{} : known->second);
  }
  return answers;
}

}  // namespace roci::planner::temporal_pddl::testing
