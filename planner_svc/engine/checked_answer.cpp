#include "planner_svc/engine/checked_answer.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

#include "planner_svc/engine/recorded_functions.hpp"

namespace roci::planner::engine {

using temporal::Verdict;

namespace {

constexpr std::size_t kMostFaults = 10;  // that are told
// An owner that searches twice as hard each time comes to sixteen times its first effort (arm_svc).
constexpr std::size_t kMostAsks = 5;

std::string unknown_engine(const Table& table, const std::string& name) {
  const std::string all = names_of_answering(table);
  if (stepped_named(table, name) != nullptr)
    return "engine '" + name + "' plans all the time and takes no calls; those that do: " + all;
  return "unknown engine '" + name + "'; this planner has: " + all;
}

bool is_over(const Limits& limits) {
  return (limits.cancelled && limits.cancelled()) || (limits.out_of_time && limits.out_of_time());
}

// Says how often owners were asked where that is why a goal has no plan.
void tell_asks(Answer& answer, std::size_t asks) {
  const std::string asked = "; asked " + std::to_string(asks) + " times";
  answer.reason += asked;
  for (BlockingGoal& goal : answer.blocking)
    if (!goal.proved) goal.reason += asked;
}

// Before a call ends without a plan for want of values that owners did not find, they are asked for these again.
Answer answer_asking_again(const TableEntry& entry, const Request& request, const Limits& limits,
                           RecordedFunctions& functions) {
  const auto engine = std::get<MakeAnswering>(entry.make)();
  Answer answer = engine->answer(request, limits, functions);
  std::size_t asks = 1;
  while (answer.lacks_values && asks < kMostAsks && !is_over(limits)) {
    ++asks;
    if (!functions.ask_again(limits.cancelled)) continue;
    const Statistics before = answer.statistics;
    Request rest = request;
    if (rest.work != 0) rest.work -= std::min(rest.work - 1, before.evaluated);
    answer = engine->answer(rest, limits, functions);
    answer.statistics.expanded += before.expanded;
    answer.statistics.evaluated += before.evaluated;
  }
  if (answer.lacks_values && asks > 1) tell_asks(answer, asks);
  return answer;
}

Answer answer_by(const TableEntry& entry, const Request& request, const Limits& limits,
                 FunctionSource& functions) {
  RecordedFunctions recorded(functions);
  Answer answer = answer_asking_again(entry, request, limits, recorded);
  answer.statistics.function_tuples = recorded.tuples();
  answer.statistics.function_requests = recorded.requests();
  answer.statistics.exact_values = recorded.exact();
  if (!answer.plan) return answer;
  const std::string refusal =
      refusal_of(*entry.make_checker(), {request, recorded.uses(), *answer.plan, nullptr, nullptr});
  if (refusal.empty()) return answer;
  answer.plan.reset();
  answer.verdict = Verdict::crashed;
  answer.reason = "the plan of engine '" + request.engine + "' is " + refusal;
  return answer;
}

}  // namespace

Answer without_plan(Verdict verdict, std::string reason) {
  Answer out;
  out.verdict = verdict;
  out.reason = std::move(reason);
  return out;
}

std::string refusal_of(const Checker& checker, const CheckedPlan& checked) {
  std::string text;
  try {
    const std::vector<std::string> faults = checker.faults(checked);
    for (std::size_t i = 0; i < std::min(faults.size(), kMostFaults); ++i)
      text += (text.empty() ? "" : "; ") + faults[i];
    if (faults.empty()) return "";
  } catch (const std::exception& error) {
    text = std::string("it cannot be checked, ") + error.what();
  }
  return "refused by its checker: " + text;
}

Answer answer_checked(const Table& table, const Request& request, const Limits& limits,
                      FunctionSource& functions) {
  const auto found = table.find(request.engine);
  if (found == table.end() || !std::holds_alternative<MakeAnswering>(found->second.make))
    return without_plan(Verdict::unsupported, unknown_engine(table, request.engine));
  try {
    return answer_by(found->second, request, limits, functions);
  } catch (const std::bad_alloc&) {
    return without_plan(Verdict::out_of_memory,
                        "memory ran out outside the search; give the call a larger budget");
  } catch (const std::exception& error) {
    return without_plan(Verdict::crashed, error.what());
  }
}

}  // namespace roci::planner::engine
