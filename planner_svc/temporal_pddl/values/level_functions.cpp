#include "planner_svc/temporal_pddl/values/level_functions.hpp"

#include <map>
#include <utility>

namespace roci::planner::temporal_pddl::values {

using engine::AssumedValue, engine::FunctionCall, engine::FunctionValue;
using pddl::LevelParameter;

namespace {

// The call as its owner knows it: the last arguments are levels.
FunctionCall without_levels(const FunctionCall& call, const std::vector<const LevelParameter*>& parameters) {
  FunctionCall out = call;
  const std::size_t own = call.arguments.size() - parameters.size();
  out.arguments.resize(own);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::string& object = call.arguments[own + i];
    std::string fluent = "(" + parameters[i]->fluent;
    for (const std::size_t position : parameters[i]->arguments) fluent += " " + call.arguments[position];
    out.state.push_back({fluent + ")", parameters[i]->levels.at(object), object});
  }
  return out;
}

std::string key(const std::vector<AssumedValue>& state) {
  std::string out;
  for (const AssumedValue& assumed : state) out += assumed.timeline + " " + assumed.object + " ";
  return out;
}

}  // namespace

std::vector<const LevelParameter*> LevelFunctions::levels_of(const std::string& function) const {
  std::vector<const LevelParameter*> out;
  for (const LevelParameter& parameter : parameters_)
    if (parameter.function == function) out.push_back(&parameter);
  return out;
}

std::vector<FunctionValue> LevelFunctions::evaluate(std::span<const FunctionCall> calls,
                                                    const std::function<bool()>& cancelled) {
  if (calls.empty()) return {};
  const auto parameters = levels_of(calls.front().function);
  if (parameters.empty()) return owners_.evaluate(calls, cancelled);
  std::map<std::string, std::pair<std::vector<FunctionCall>, std::vector<std::size_t>>> batches;  // by state
  for (std::size_t i = 0; i < calls.size(); ++i) {
    FunctionCall call = without_levels(calls[i], parameters);
    auto& [of_state, places] = batches[key(call.state)];
    of_state.push_back(std::move(call));
    places.push_back(i);
  }
  std::vector<FunctionValue> answers(calls.size());
  for (auto& [state, batch] : batches) {
    std::vector<FunctionValue> values = owners_.evaluate(batch.first, cancelled);
    if (values.size() != batch.first.size()) continue;
    for (std::size_t k = 0; k < values.size(); ++k) answers[batch.second[k]] = std::move(values[k]);
  }
  return answers;
}

}  // namespace roci::planner::temporal_pddl::values
