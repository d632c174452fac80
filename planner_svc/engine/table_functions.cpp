#include "planner_svc/engine/table_functions.hpp"

namespace roci::planner::engine {

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
  answer.provenance.owner = owner_;
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

pddl::FunctionTables tables_of(std::span<const FunctionUse> uses) {
  pddl::FunctionTables tables;
  for (const FunctionUse& use : uses) {
    const bool has_value = use.answer.outcome == FunctionOutcome::value;
    if (use.answer.outcome == FunctionOutcome::unknown) {
      tables.unknown.insert(application(use.call));
    } else if (has_value && !use.answer.is_exact()) {
      tables.lower_bounds.emplace(application(use.call), use.answer.value);
    } else {
      pddl::put(tables.exact, use.call.function, use.call.arguments,
                has_value ? std::optional(use.answer.value) : std::nullopt);
    }
  }
  return tables;
}

}  // namespace roci::planner::engine
