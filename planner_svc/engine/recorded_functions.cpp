#include "planner_svc/engine/recorded_functions.hpp"

#include <algorithm>
#include <utility>

namespace roci::planner::engine {

namespace {

// Tells apart what one batch may not mix, too.
std::string batch_of(const FunctionCall& call) {
  std::string out = call.module + " " + call.function;
  for (const AssumedValue& assumed : call.state)
    out += " " + assumed.timeline + "=" + std::to_string(assumed.number);
  return out;
}

std::string key_of(const FunctionCall& call) {
  return batch_of(call) + " " + std::to_string(static_cast<int>(call.accuracy)) + application(call);
}

bool is_unknown(const FunctionUse& use) {
  return use.answer.outcome == FunctionOutcome::unknown && use.answer.is_exact();
}

}  // namespace

std::vector<FunctionValue> RecordedFunctions::ask(std::span<const FunctionCall> calls,
                                                  const std::function<bool()>& cancelled) {
  std::vector<FunctionValue> values = source_.evaluate(calls, cancelled);
  ++requests_;
  if (values.size() != calls.size()) return values;
  tuples_ += values.size();
  exact_ += static_cast<std::uint64_t>(std::ranges::count_if(values, &FunctionValue::is_exact));
  return values;
}

std::vector<FunctionValue> RecordedFunctions::evaluate(std::span<const FunctionCall> calls,
                                                       const std::function<bool()>& cancelled) {
  if (!known_.empty()) return recalled(calls, cancelled);
  std::vector<FunctionValue> values = ask(calls, cancelled);
  if (values.size() == calls.size())
    for (std::size_t i = 0; i < calls.size(); ++i) uses_.push_back({calls[i], values[i]});
  return values;
}

std::vector<FunctionValue> RecordedFunctions::recalled(std::span<const FunctionCall> calls,
                                                       const std::function<bool()>& cancelled) {
  std::vector<FunctionCall> missing;
  for (const FunctionCall& call : calls)
    if (!known_.contains(key_of(call))) missing.push_back(call);
  if (!missing.empty()) {
    const std::vector<FunctionValue> values = ask(missing, cancelled);
    if (values.size() != missing.size()) return values;
    for (std::size_t i = 0; i < missing.size(); ++i) {
      known_[key_of(missing[i])] = uses_.size();
      uses_.push_back({missing[i], values[i]});
    }
  }
  std::vector<FunctionValue> out;
  out.reserve(calls.size());
  for (const FunctionCall& call : calls) out.push_back(uses_[known_.at(key_of(call))].answer);
  return out;
}

bool RecordedFunctions::ask_again(const std::function<bool()>& cancelled) {
  if (known_.empty())
    for (std::size_t i = 0; i < uses_.size(); ++i) known_[key_of(uses_[i].call)] = i;
  std::map<std::string, std::vector<std::size_t>> batches;
  for (std::size_t i = 0; i < uses_.size(); ++i)
    if (is_unknown(uses_[i])) batches[batch_of(uses_[i].call)].push_back(i);
  bool changed = false;
  for (const auto& [name, places] : batches) {
    std::vector<FunctionCall> calls;
    for (const std::size_t place : places) {
      calls.push_back(uses_[place].call);
      calls.back().accuracy = temporal::FunctionAccuracy::exact;
    }
    std::vector<FunctionValue> values = ask(calls, cancelled);
    if (values.size() != calls.size()) continue;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const FunctionOutcome outcome = values[k].outcome;
      if (outcome != FunctionOutcome::value && outcome != FunctionOutcome::unreachable) continue;
      uses_[places[k]].answer = std::move(values[k]);
      changed = true;
    }
  }
  return changed;
}

}  // namespace roci::planner::engine
