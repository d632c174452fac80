#include "planner_svc/temporal_pddl/values/counted_functions.hpp"

#include <algorithm>

namespace roci::planner::temporal_pddl::values {

using engine::FunctionCall, engine::FunctionValue;

std::vector<FunctionValue> CountedFunctions::evaluate(std::span<const FunctionCall> calls,
                                                      const std::function<bool()>& cancelled) {
  std::vector<FunctionValue> answers = source_.evaluate(calls, cancelled);
  const auto cheap = static_cast<std::size_t>(
      std::ranges::count_if(answers, [](const auto& one) { return !one.is_exact(); }));
  ++requests_;
  cheap_ += cheap;
  exact_ += calls.size() - std::min(cheap, calls.size());
  return answers;
}

}  // namespace roci::planner::temporal_pddl::values
