#include "planner_svc/temporal_pddl/cli/table_functions.hpp"

namespace roci::planner::temporal_pddl::cli {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionValue;

std::vector<FunctionValue> TableFunctions::evaluate(std::span<const FunctionCall> calls,
                                                    const std::function<bool()>&) {
  std::vector<FunctionValue> answers;
  for (const FunctionCall& call : calls) {
    std::string application = "(" + call.function;
    for (const auto& argument : call.arguments) application += " " + argument;
    FunctionValue answer;
    answer.provenance.owner = owner_;
    const auto entry = table_.find(application + ")");
    if (entry != table_.end()) {
      answer.outcome = entry->second ? FunctionOutcome::value : FunctionOutcome::unreachable;
      answer.value = entry->second.value_or(0);
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace roci::planner::temporal_pddl::cli
