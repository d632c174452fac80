#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

const char* to_string(FunctionOutcome outcome) {
  switch (outcome) {
    case FunctionOutcome::value:
      return "value";
    case FunctionOutcome::unreachable:
      return "unreachable";
    case FunctionOutcome::unavailable:
      return "unavailable";
    case FunctionOutcome::owner_lost:
      return "owner-lost";
    case FunctionOutcome::late:
      return "late";
    case FunctionOutcome::not_a_number:
      return "not-a-number";
    case FunctionOutcome::wrong_arity:
      return "wrong-arity";
    case FunctionOutcome::unknown_object:
      return "unknown-object";
  }
  return "unknown";
}

std::vector<FunctionValue> NoFunctions::evaluate(std::span<const FunctionCall> calls,
                                                 const std::function<bool()>&) {
  return std::vector<FunctionValue>(calls.size());
}

}  // namespace roci::planner::engine
