#include "planner_svc/temporal_pddl/cli/table_functions.hpp"

namespace roci::planner::temporal_pddl::cli {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionValue;
using temporal::FunctionAccuracy;

std::vector<FunctionValue> TableFunctions::evaluate(std::span<const FunctionCall> calls,
                                                    const std::function<bool()>&) {
  std::vector<FunctionValue> answers;
  answers.reserve(calls.size());
  for (const FunctionCall& call : calls) answers.push_back(answer(call));
  return answers;
}

FunctionValue TableFunctions::answer(const FunctionCall& call) const {
  const std::string tuple = application(call);
  FunctionValue answer;
  answer.provenance = owner_;
  if (call.accuracy == FunctionAccuracy::lower_bound) {
    if (const auto bound = tables_.lower_bounds.find(tuple); bound != tables_.lower_bounds.end()) {
      answer.outcome = FunctionOutcome::value;
      answer.value = bound->second;
      answer.accuracy = FunctionAccuracy::lower_bound;
      return answer;
    }
  }
  if (tables_.unknown.contains(tuple)) {
    answer.outcome = FunctionOutcome::unknown;
  } else if (const auto entry = tables_.exact.find(tuple); entry != tables_.exact.end()) {
    answer.outcome = entry->second ? FunctionOutcome::value : FunctionOutcome::unreachable;
    answer.value = entry->second.value_or(0);
  }
  return answer;
}

}  // namespace roci::planner::temporal_pddl::cli
