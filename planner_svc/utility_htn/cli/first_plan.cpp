#include "planner_svc/utility_htn/cli/first_plan.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "planner_svc/utility_htn/cli/words.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"
#include "planner_svc/utility_htn/search/explanation.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::cli {

using flattening::Chain, flattening::Chains;
using model::Network, model::TaskIndex, model::Values;
using temporal::Time;

namespace {

Values values_of(const Network& network, const WhatIf& asked) {
  Values out = model::priors(network);
  for (const auto& [name, value] : asked.values) {
    const auto found = std::ranges::find(network.parameters, name, &model::Parameter::name);
    if (found == network.parameters.end())
      throw std::invalid_argument("the network has no parameter '" + name + "'; " +
                                  "roci-network unpack lists those it has");
    if (!found->permits(value))
      throw std::invalid_argument("'" + name + "' is " + number(value) + ", and goes from " +
                                  number(found->lowest) + " to " + number(found->highest));
    out[static_cast<std::size_t>(found - network.parameters.begin())] = value;
  }
  return out;
}

// The network with other first values.
Network begun_with(Network network, const WhatIf& asked) {
  for (const auto& [name, value] : asked.initial) {
    const auto found = std::ranges::find(network.timelines, name, &temporal::timelines::Definition::name);
    if (found == network.timelines.end())
      throw std::invalid_argument("the network has no timeline '" + name + "'");
    if (found->states.empty() && !(value >= found->lowest && value <= found->highest))
      throw std::invalid_argument("'" + name + "' would begin with " + number(value) + ", and goes from " +
                                  number(found->lowest) + " to " + number(found->highest));
    found->initial = value;
  }
  return network;
}

double cost_of(const search::Problem& problem, std::uint32_t chain) {
  return flattening::cost(problem.network, problem.chains.chains[chain], problem.values);
}

PlannedTask planned_task(const search::Problem& problem, const search::Placed& placed,
                         const std::vector<std::uint32_t>& before) {
  const Chain& chain = problem.chains.chains[placed.chain];
  PlannedTask out;
  out.chain = chain.name;
  out.start = placed.starts.front();
  const model::Task& last = problem.network.tasks[chain.links.back().task];
  out.end = placed.starts.back() + temporal::seconds(model::evaluate(last.duration, problem.values));
  out.utility = problem.assessor.predicted(
      placed.chain, {problem.network, problem.values, problem.chains, problem.timelines_now, problem.products,
                     before, problem.closed});
  out.cost = cost_of(problem, placed.chain);
  return out;
}

// Of each request that is not planned why none of its chains is, the one that is worth most first.
std::vector<UnplannedTask> unplanned(const search::Problem& problem, const search::Outcome& outcome) {
  std::set<TaskIndex> held(problem.closed.begin(), problem.closed.end());
  for (const search::Placed& placed : outcome.plan.placed)
    held.insert(problem.chains.chains[placed.chain].task);
  std::vector<UnplannedTask> out;
  for (TaskIndex task = 0; task < problem.network.tasks.size(); ++task) {
    if (held.contains(task)) continue;
    std::vector<std::uint32_t> ways;
    for (std::uint32_t chain = 0; chain < problem.chains.chains.size(); ++chain)
      if (problem.chains.chains[chain].task == task) ways.push_back(chain);
    std::ranges::stable_sort(ways, [&](std::uint32_t a, std::uint32_t b) {
      return flattening::utility(problem.network, problem.chains.chains[a], problem.values) >
             flattening::utility(problem.network, problem.chains.chains[b], problem.values);
    });
    UnplannedTask one{problem.network.tasks[task].id, {}};
    for (const std::uint32_t way : ways) one.why.push_back(search::why_not(problem, outcome, way).text);
    if (!one.why.empty()) out.push_back(std::move(one));
  }
  return out;
}

nlohmann::ordered_json to_json(const temporal::RankVector& utility) {
  return std::vector<double>(utility.scores().begin(), utility.scores().end());
}

}  // namespace

FirstPlan first_plan(const Network& original, const WhatIf& asked) {
  const Values values = values_of(original, asked);
  const Network network = begun_with(original, asked);
  const Chains chains = flattening::flatten(network);
  const assessor::SubwayAssessor assessor(network, chains);
  const std::unique_ptr<search::Scheduler> scheduler = search::make_scheduler("nearest");
  temporal::timelines::Timelines timelines(network.timelines, Time{0});
  std::vector<double> now;
  for (const auto& definition : network.timelines) now.push_back(definition.initial);
  search::Problem problem{network, values, chains, assessor, *scheduler, timelines};
  problem.from = network.cycle.commit_window;
  problem.until = network.cycle.plan_end;
  const auto& budget = network.timelines[network.budget];
  problem.budget = budget.initial - budget.lowest;
  problem.timelines_now = now;
  for (TaskIndex task = 0; task < network.tasks.size(); ++task)
    if (network.tasks[task].is_template) problem.closed.push_back(task);
  delivery::Delivery delivery(network);
  delivery.join(problem, Time{0});
  const search::Outcome outcome = search::search(problem);
  FirstPlan out{{},
                unplanned(problem, outcome),
                outcome.plan.utility,
                outcome.plan.cost,
                problem.budget,
                outcome.complete,
                outcome.statistics.entries};
  std::vector<std::uint32_t> before;
  for (const search::Placed& placed : outcome.plan.placed) {
    out.planned.push_back(planned_task(problem, placed, before));
    before.push_back(placed.chain);
  }
  return out;
}

std::string plan_text(const Network& network, const FirstPlan& plan, const std::vector<std::string>& tasks) {
  const std::string& unit = network.timelines[network.budget].name;
  std::string out = "network '" + network.name + "', version " + std::to_string(network.version) + ": of " +
                    number(plan.budget) + " of " + unit + " the first plan takes " + number(plan.cost) +
                    " for utility " + in_ranks(plan.utility, network) + "\n";
  std::size_t widest = 0;
  for (const PlannedTask& one : plan.planned) widest = std::max(widest, one.chain.size());
  for (const PlannedTask& one : plan.planned)
    out += "  " + padded(one.chain, widest) + "  " + temporal::to_text(one.start) + " to " +
           temporal::to_text(one.end) + ", " + number(one.cost) + ", utility " +
           in_ranks(one.utility, network) + "\n";
  if (!plan.complete)
    out += "  the search ended at its bound, after " + std::to_string(plan.explored) +
           " entries: a better plan may exist\n";
  for (const UnplannedTask& one : plan.unplanned) {
    const bool named = std::ranges::find(tasks, one.task) != tasks.end();
    if (!tasks.empty() && !named) continue;
    for (const std::string& why : one.why) {
      out += why + "\n";
      if (!named) break;
    }
  }
  return out;
}

std::string plan_json(const Network& network, const FirstPlan& plan) {
  nlohmann::ordered_json out = {{"network", network.name},
                                {"version", network.version},
                                {"ranks", network.ranks},
                                {"timeline", network.timelines[network.budget].name},
                                {"budget", plan.budget},
                                {"cost", plan.cost},
                                {"utility", to_json(plan.utility)},
                                {"complete", plan.complete},
                                {"explored", plan.explored},
                                {"planned", nlohmann::ordered_json::array()},
                                {"unplanned", nlohmann::ordered_json::array()}};
  for (const PlannedTask& one : plan.planned)
    out["planned"].push_back({{"chain", one.chain},
                              {"start_s", temporal::to_seconds(one.start)},
                              {"end_s", temporal::to_seconds(one.end)},
                              {"utility", to_json(one.utility)},
                              {"cost", one.cost}});
  for (const UnplannedTask& one : plan.unplanned)
    out["unplanned"].push_back({{"task", one.task}, {"why", one.why}});
  return out.dump(2);
}

}  // namespace roci::planner::utility_htn::cli
