#include "planner_svc/engine/function_source.hpp"

#include <algorithm>

namespace roci::planner::engine {

const char* to_string(FunctionsMode mode) {
  switch (mode) {
    case FunctionsMode::eager:
      return "eager";
    case FunctionsMode::lazy:
      return "lazy";
    case FunctionsMode::two_accuracy:
      return "two_accuracy";
  }
  return "eager";
}

std::optional<FunctionsMode> functions_mode_named(std::string_view name) {
  std::string plain(name);
  std::ranges::replace(plain, '-', '_');
  for (const FunctionsMode mode : {FunctionsMode::eager, FunctionsMode::lazy, FunctionsMode::two_accuracy})
    if (plain == to_string(mode)) return mode;
  return std::nullopt;
}

std::string application(const FunctionCall& call) {
  std::string text = "(" + call.function;
  for (const std::string& argument : call.arguments) text += " " + argument;
  for (const AssumedValue& assumed : call.state) text += " " + assumed.object;
  return text + ")";
}

const char* to_string(FunctionOutcome outcome) {
  switch (outcome) {
    case FunctionOutcome::value:
      return "value";
    case FunctionOutcome::unreachable:
      return "unreachable";
    case FunctionOutcome::unknown:
      return "unknown";
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
  return "unavailable";
}

std::vector<FunctionValue> NoFunctions::evaluate(std::span<const FunctionCall> calls,
                                                 const std::function<bool()>&) {
  return std::vector<FunctionValue>(calls.size());
}

}  // namespace roci::planner::engine
