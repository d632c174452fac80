#include "planner_svc/temporal_pddl/values/value_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace roci::planner::temporal_pddl::values {

using engine::FunctionCall, engine::FunctionOutcome, engine::FunctionsMode, engine::FunctionUse,
    engine::FunctionValue;
using temporal::FunctionAccuracy;

namespace {

constexpr std::size_t kMostWarnings = 10;

bool is_value(const FunctionValue& answer) { return answer.outcome == FunctionOutcome::value; }

// Bounds and values are computed in different ways, so that they may differ in the last digits.
bool is_above(double bound, double value) {
  return bound > value + 1e-9 * std::max({1.0, std::abs(bound), std::abs(value)});
}

std::string broken_bound(const FunctionCall& call, const FunctionValue& bound, const FunctionValue& exact) {
  std::ostringstream text;
  text << (exact.provenance->owner.empty() ? "the owner" : exact.provenance->owner) << " gave " << bound.value
       << " as a lower bound of " << application(call) << " of module " << call.module << ", and "
       << exact.value << " as its exact value, which is less; the exact value counts";
  return text.str();
}

}  // namespace

// What the owner cannot say at all, or proved, it would say again.
bool ValueTable::Known::exact() const {
  return asked && (value.is_exact() || value.outcome == FunctionOutcome::unreachable);
}

std::vector<FunctionValue> ValueTable::ask(std::vector<FunctionCall> calls, FunctionAccuracy accuracy) {
  for (FunctionCall& call : calls) call.accuracy = accuracy;
  std::vector<FunctionValue> answers = owners_.evaluate(calls, cancelled_);
  if (answers.size() != calls.size()) answers.assign(calls.size(), FunctionValue{});
  for (FunctionValue& answer : answers)
    if (is_value(answer) && !std::isfinite(answer.value)) answer.outcome = FunctionOutcome::not_a_number;
  return answers;
}

void ValueTable::load(Function& function, std::span<const FunctionCall> calls) {
  function.tuples = TupleSet(calls);
  function.known.resize(calls.size());
  const bool exactly = exactly_.contains(calls.front().function);
  if (mode_ == FunctionsMode::lazy && !exactly) return;
  std::vector<FunctionValue> answers =
      ask({calls.begin(), calls.end()}, exactly ? FunctionAccuracy::exact : FunctionAccuracy::lower_bound);
  std::set<std::size_t> without_bound;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (answers[i].outcome == FunctionOutcome::unknown && !answers[i].is_exact()) without_bound.insert(i);
    function.known[i] = {std::move(answers[i]), true};
  }
  refine(function, without_bound);
}

std::vector<FunctionValue> ValueTable::evaluate(std::span<const FunctionCall> calls,
                                                const std::function<bool()>&) {
  if (calls.empty()) return {};
  Function& function = functions_[calls.front().function];
  if (function.tuples.empty()) load(function, calls);
  std::vector<FunctionValue> answers;
  answers.reserve(calls.size());
  for (std::size_t i = 0; i < calls.size(); ++i) {  // mostly all of them, in their order
    const std::vector<std::string>& arguments = calls[i].arguments;
    const std::size_t place =
        function.tuples.is_at(i, arguments) ? i : function.tuples.find(arguments).value();
    answers.push_back(given(function, place));
  }
  return answers;
}

FunctionValue ValueTable::given(const Function& function, std::size_t index) const {
  const Known& known = function.known[index];
  if (known.exact()) return known.value;
  FunctionValue answer = known.value;
  if (exact_alone_) {
    answer.outcome = FunctionOutcome::unreachable;
  } else if (!known.asked) {
    answer.outcome = FunctionOutcome::value;
    answer.value = function.smallest;
    answer.accuracy = FunctionAccuracy::estimate;
  }
  return answer;
}

Refined ValueTable::refine(std::span<const FunctionCall> calls) {
  std::map<std::string, std::set<std::size_t>> wanted;
  for (const FunctionCall& call : calls) {
    const auto function = functions_.find(call.function);
    if (function == functions_.end()) continue;
    if (const auto index = function->second.tuples.find(call.arguments)) wanted[call.function].insert(*index);
  }
  Refined total;
  for (const auto& [name, tuples] : wanted) {
    const Refined one = refine(functions_.at(name), tuples);
    total.asked += one.asked;
    total.changed = total.changed || one.changed;
  }
  return total;
}

Refined ValueTable::refine_all() {
  Refined total;
  for (auto& [name, function] : functions_) {
    std::set<std::size_t> all;
    for (std::size_t i = 0; i < function.tuples.size(); ++i) all.insert(all.end(), i);
    const Refined one = refine(function, all);
    total.asked += one.asked;
    total.changed = total.changed || one.changed;
  }
  return total;
}

Refined ValueTable::refine(Function& function, const std::set<std::size_t>& wanted) {
  std::vector<std::size_t> tuples;
  std::vector<FunctionCall> calls;
  for (const std::size_t i : wanted) {
    if (function.known[i].exact()) continue;
    tuples.push_back(i);
    calls.push_back(function.tuples.call(i));
  }
  Refined refined;
  if (calls.empty()) return refined;
  std::vector<FunctionValue> answers = ask(std::move(calls), FunctionAccuracy::exact);
  for (std::size_t k = 0; k < tuples.size(); ++k) {
    answers[k].accuracy = FunctionAccuracy::exact;  // also of what did not come: it is not asked for again
    take_exact(function, tuples[k], std::move(answers[k]), refined);
  }
  return refined;
}

void ValueTable::take_exact(Function& function, std::size_t index, FunctionValue value, Refined& refined) {
  Known& known = function.known[index];
  const FunctionValue before = given(function, index);
  ++refined.asked;
  refined.changed = refined.changed || value.outcome != before.outcome || value.value != before.value;
  if (known.asked && is_value(known.value) && known.value.accuracy == FunctionAccuracy::lower_bound &&
      is_value(value) && is_above(known.value.value, value.value) && warnings_.size() < kMostWarnings)
    warnings_.push_back(broken_bound(function.tuples.call(index), known.value, value));
  if (is_value(value)) {
    function.smallest = function.has_exact ? std::min(function.smallest, value.value) : value.value;
    function.has_exact = true;
  }
  known = {std::move(value), true};
}

bool ValueTable::is_exact() const {
  return std::ranges::all_of(functions_, [](const auto& entry) {
    return std::ranges::all_of(entry.second.known, [](const Known& known) { return known.exact(); });
  });
}

std::vector<FunctionUse> ValueTable::take_uses() {
  std::vector<FunctionUse> uses;
  std::size_t count = 0;
  for (const auto& [name, function] : functions_)
    count += static_cast<std::size_t>(std::ranges::count_if(function.known, &Known::asked));
  uses.reserve(count);
  for (auto& [name, function] : functions_) {
    for (std::size_t i = 0; i < function.tuples.size(); ++i)
      if (function.known[i].asked)
        uses.push_back({function.tuples.call(i), std::move(function.known[i].value)});
    function = {};
  }
  functions_.clear();
  return uses;
}

}  // namespace roci::planner::temporal_pddl::values
