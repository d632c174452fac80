#include "planner_svc/engine/checked_answer.hpp"

#include <algorithm>
#include <exception>
#include <new>
#include <utility>

namespace roci::planner::engine {

using temporal::Verdict;

namespace {

constexpr std::size_t kMostFaults = 10;  // that are told

// Passes calls on and keeps what the owners answered, so that the checker hears it from them.
class RecordedFunctions final : public FunctionSource {
 public:
  explicit RecordedFunctions(FunctionSource& source) : source_(source) {}

  std::vector<FunctionValue> evaluate(std::span<const FunctionCall> calls,
                                      const std::function<bool()>& cancelled) override {
    std::vector<FunctionValue> values = source_.evaluate(calls, cancelled);
    ++requests_;
    if (values.size() == calls.size())
      for (std::size_t i = 0; i < calls.size(); ++i) uses_.push_back({calls[i], values[i]});
    return values;
  }

  std::span<const FunctionUse> uses() const { return uses_; }
  std::uint64_t requests() const { return requests_; }
  std::uint64_t exact() const {
    return static_cast<std::uint64_t>(
        std::ranges::count_if(uses_, [](const FunctionUse& use) { return use.answer.is_exact(); }));
  }

 private:
  FunctionSource& source_;
  std::uint64_t requests_ = 0;
  std::vector<FunctionUse> uses_;
};

std::string unknown_engine(const Table& table, const std::string& name) {
  const std::string all = names_of_answering(table);
  if (stepped_named(table, name) != nullptr)
    return "engine '" + name + "' plans all the time and takes no calls; those that do: " + all;
  return "unknown engine '" + name + "'; this planner has: " + all;
}

Answer answer_by(const TableEntry& entry, const Request& request, const Limits& limits,
                 FunctionSource& functions) {
  RecordedFunctions recorded(functions);
  Answer answer = std::get<MakeAnswering>(entry.make)()->answer(request, limits, recorded);
  answer.statistics.function_tuples = recorded.uses().size();
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
