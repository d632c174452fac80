#include "planner_svc/timeline_htn/adapter/timeline_engine.hpp"

#include <algorithm>

#include "planner_svc/engine/table_functions.hpp"
#include "planner_svc/timeline_htn/adapter/owners_values.hpp"
#include "planner_svc/timeline_htn/extraction/plan_of.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/request/asked_numbers.hpp"
#include "planner_svc/timeline_htn/request/problem_of.hpp"

namespace roci::planner::timeline_htn::adapter {

using engine::Answer, engine::FunctionSource, engine::Limits, engine::Request;
using model::Model;
using search::Outcome, search::Resolution;
using temporal::Verdict;

namespace {

constexpr std::uint64_t kWork = 10'000'000;  // steps, where a request has no bound

engine::BlockingGoal blocking(const std::string& key, const std::string& timeline,
                              const std::string& reason) {
  const std::size_t slash = key.rfind('/');
  return {key.substr(0, slash), slash == std::string::npos ? "" : key.substr(slash + 1), timeline, reason};
}

Answer misfitting(const std::vector<request::Misfit>& misfits) {
  const bool whole =
      std::ranges::any_of(misfits, [](const request::Misfit& one) { return one.goal.empty(); });
  Answer out = engine::without_plan(whole ? Verdict::invalid_input : Verdict::unsolvable, "");
  for (const request::Misfit& one : misfits) {
    out.reason +=
        (out.reason.empty() ? "" : "\n") + (one.goal.empty() ? "" : "goal '" + one.goal + "': ") + one.what;
    if (!one.goal.empty()) out.blocking.push_back(blocking(one.goal, "", one.what));
  }
  return out;
}

Answer faulty(const std::vector<model::Fault>& faults, const Model& model) {
  Answer out = engine::without_plan(Verdict::invalid_input, "");
  for (const model::Fault& fault : faults) {
    if (fault.warning) continue;
    if (fault.part == model::Part::goal) {
      out.blocking.push_back(blocking(model.problem->goals[fault.index].id, "", fault.what));
      out.verdict = Verdict::unsolvable;
    }
    out.reason += (out.reason.empty() ? "" : "\n") + fault.what + "; " + fault.remedy;
  }
  return out;
}

Verdict verdict_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::solved:
      return Verdict::solved;
    case Outcome::exhausted:
      return Verdict::unsolvable;
    case Outcome::out_of_memory:
      return Verdict::out_of_memory;
    case Outcome::cancelled:
      return Verdict::cancelled;
    case Outcome::searching:
      return Verdict::timeout;
  }
  return Verdict::crashed;
}

Answer answer_of(const Request& request, const Model& model, const Resolution& resolution, bool out_of_time) {
  Answer out;
  out.verdict = verdict_of(resolution.outcome);
  if (out.verdict == Verdict::cancelled && out_of_time) out.verdict = Verdict::timeout;
  const search::Search& search = *resolution.search;
  out.statistics.expanded = resolution.expanded;
  out.statistics.evaluated = resolution.evaluated;
  const auto nodes = static_cast<double>(std::max<std::size_t>(1, search.count().nodes));
  out.statistics.bytes_per_state = static_cast<double>(search.count().bytes) / nodes;
  if (out.verdict == Verdict::solved) {
    const std::string origin = std::to_string(request.origin.count());
    out.plan = extraction::plan_of(search, {"timeline_htn-" + origin, origin + "/", request.origin});
    return out;
  }
  out.reason = out.verdict == Verdict::unsolvable
                   ? search.reason()
                   : "no plan was found in this budget; so far: " + search.reason();
  const model::Index goal = search.blocking_goal();
  if (out.verdict == Verdict::unsolvable && goal < model.problem->goals.size()) {
    const model::Goal& one = model.problem->goals[goal];
    out.blocking = {blocking(one.id, model.components[one.state.component].name, search.reason())};
  }
  return out;
}

}  // namespace

Answer TimelineEngine::answer(const Request& request, const Limits& limits, FunctionSource& functions) {
  mission::Findings findings;
  std::optional<Model> model = request::read_model(request, findings);
  if (!model) return engine::without_plan(Verdict::invalid_input, reading::errors_of(findings));
  const std::vector<request::Misfit> misfits = request::put_request(request, *model);
  if (!misfits.empty()) return misfitting(misfits);
  const request::Asked asked = request::ask_numbers(*model, functions, limits.cancelled);
  if (asked.verdict != Verdict::solved) return engine::without_plan(asked.verdict, asked.reason);
  const std::vector<model::Fault> faults = model::check(*model);
  if (!model::usable(faults)) {
    Answer out = faulty(faults, *model);
    explain(out, *model, request, asked.uses);
    return out;
  }
  Settings settings = settings_;
  if (!request.resolvers.empty()) settings = {{}, request.threads};
  for (const std::string& name : request.resolvers) {
    const auto resolver = search::resolver_named(name);
    if (!resolver) return engine::without_plan(Verdict::invalid_input, "there is no resolver '" + name + "'");
    settings.resolvers.push_back(*resolver);
  }
  bool out_of_time = false;
  const Resolution resolution =
      search::resolve(*model, settings.resolvers, settings.threads, request.work == 0 ? kWork : request.work,
                      request.memory_bytes, [&] { return limits.cancelled() || limits.out_of_time(); });
  if (resolution.outcome == Outcome::cancelled) out_of_time = !limits.cancelled();
  Answer out = answer_of(request, *model, resolution, out_of_time);
  if (out.plan) out.plan->function_values = values_of(*resolution.search, *out.plan, asked.uses);
  explain(out, *model, request, asked.uses);
  if (!asked.uses.empty()) out.record = {{".values", pddl::print(engine::tables_of(asked.uses))}};
  for (const auto& finding : findings.all()) out.warnings.push_back(finding.text());
  return out;
}

std::vector<engine::AskedFunction> asked_functions(const std::string& model, const std::string& name) {
  std::vector<engine::AskedFunction> out;
  mission::Findings findings;
  const auto read = reading::parse_model({{name, model}}, findings, reading::Problem::of_a_request);
  if (!read) return out;
  for (const model::NumberTable& table : read->numbers)
    if (table.asked) out.push_back({table.asked->module, table.asked->function, table.asked->place});
  return out;
}

std::vector<std::string> check_model(const std::string& model, const std::string& name,
                                     mission::Findings& findings) {
  std::vector<std::string> out;
  const auto read = reading::parse_model({{name, model}}, findings, reading::Problem::of_a_request);
  if (!read) return out;
  for (const model::Component& component : read->components)
    for (const model::State& state : component.states)
      if (state.observed) out.push_back(state.observed->timeline);
  for (const model::Relation& relation : read->relations)
    if (!relation.timeline.empty()) out.push_back(relation.timeline + ".");
  return out;
}

}  // namespace roci::planner::timeline_htn::adapter
