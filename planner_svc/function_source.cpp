#include "planner_svc/function_source.hpp"

namespace roci::planner {

const char* to_string(FunctionOutcome outcome) {
  switch (outcome) {
    case FunctionOutcome::kValue:
      return "value";
    case FunctionOutcome::kUnreachable:
      return "unreachable";
    case FunctionOutcome::kUnavailable:
      return "unavailable";
    case FunctionOutcome::kOwnerLost:
      return "owner-lost";
    case FunctionOutcome::kLate:
      return "late";
    case FunctionOutcome::kNotANumber:
      return "not-a-number";
    case FunctionOutcome::kWrongArity:
      return "wrong-arity";
    case FunctionOutcome::kUnknownObject:
      return "unknown-object";
  }
  return "unknown";
}

std::vector<FunctionValue> NoFunctions::evaluate(std::span<const FunctionCall> calls,
                                                 const std::function<bool()>&) {
  return std::vector<FunctionValue>(calls.size());
}

}  // namespace roci::planner
