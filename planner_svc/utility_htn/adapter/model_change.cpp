// What the ground changes of the network in force (R83, R118).
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "planner_svc/utility_htn/adapter/index_of.hpp"
#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "planner_svc/utility_htn/adapter/planned_network.hpp"
#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::adapter {

using cycle::Block, cycle::Link;
using model::Network;
using temporal::Time;

namespace {

// Returns the chain that is done for the same request in the same way; null: the network has none.
const flattening::Chain* counterpart(const Network& network, const flattening::Chain& chain,
                                     const Network& next, const flattening::Chains& chains) {
  const auto task_id = [](const Network& of) {
    return [&of](const model::Subtask& link) -> const std::string& { return of.tasks[link.task].id; };
  };
  const auto found = std::ranges::find_if(chains.chains, [&](const flattening::Chain& other) {
    return other.name == chain.name && next.tasks[other.task].id == network.tasks[chain.task].id &&
           std::ranges::equal(other.links, chain.links, {}, task_id(next), task_id(network));
  });
  return found == chains.chains.end() ? nullptr : &*found;
}

// Takes over what was found out: what is done, what was withdrawn and how often each request has failed, what
// contingencies ask for, values that are no priors, and timelines as they are now.
cycle::Past past_for(const Network& next, const Network& before, const cycle::Cycle& cycle, Time now) {
  cycle::Past out{.values = model::priors(next)};
  const auto take_over = [&](const std::set<model::TaskIndex>& tasks, std::set<model::TaskIndex>& taken) {
    for (const model::TaskIndex task : tasks)
      if (const auto same = index_of(next.tasks, before.tasks[task].id, &model::Task::id))
        taken.insert(*same);
  };
  take_over(cycle.past().done, out.done);
  take_over(cycle.past().withdrawn, out.withdrawn);
  take_over(cycle.past().contingent, out.contingent);
  for (const auto& [task, times] : cycle.past().failures)
    if (const auto same = index_of(next.tasks, before.tasks[task].id, &model::Task::id))
      out.failures[*same] = times;
  for (std::size_t i = 0; i < before.parameters.size(); ++i) {
    const double value = cycle.past().values[i];
    const auto same = index_of(next.parameters, before.parameters[i].name, &model::Parameter::name);
    if (!same || value == before.parameters[i].prior) continue;
    if (next.parameters[*same].permits(value)) out.values[*same] = value;
  }
  for (const auto& timeline : next.timelines) {
    const auto same = index_of(before.timelines, timeline.name, &temporal::timelines::Definition::name);
    const auto value =
        same && !timeline.is_claim()
            ? number_of(timeline, value_of(before.timelines[*same], cycle.timelines().value(*same, now)))
            : std::nullopt;
    out.internal.push_back(value.value_or(timeline.initial));
  }
  return out;
}

}  // namespace

std::optional<Network> PlannedNetwork::usable_network(const engine::ModelChange& change,
                                                      std::vector<std::string>& refused) const {
  mission::Findings findings;
  std::optional<Network> next =
      reading::take_network(*change.model, "network of " + change.issuer + "/" + change.id, findings);
  for (const mission::Finding& finding : findings.sorted())
    if (finding.severity == mission::Severity::error)
      refused.push_back(finding.text() + (finding.remedy.empty() ? "" : "; " + finding.remedy));
  if (!next) return std::nullopt;
  if (next->version <= network_.version) {
    refused = {"version " + std::to_string(next->version) + " of '" + next->name +
               "' is not newer than version " + std::to_string(network_.version) + " of '" + network_.name +
               "', which is in force; raise 'version'"};
    return std::nullopt;
  }
  try {
    refused = in_the_way_of(*next);
  } catch (const std::invalid_argument& error) {
    refused = {error.what()};
  }
  return refused.empty() ? std::move(next) : std::nullopt;
}

// What is committed stands (R78): a network that does not have it comes too early.
std::vector<std::string> PlannedNetwork::in_the_way_of(const Network& next) const {
  const flattening::Chains chains = flattening::flatten_all(next);
  std::vector<std::string> out;
  for (const Block& block : cycle_->blocks()) {
    if (!block.begun() || block.over()) continue;
    const flattening::Chain& chain = chains_.chains[block.chain];
    if (counterpart(network_, chain, next, chains) != nullptr) continue;
    std::string committed;
    for (const Link& link : block.links)
      if (link.stage == cycle::Stage::committed || link.stage == cycle::Stage::running)
        committed += (committed.empty() ? "'" : ", '") + network_.tasks[link.task].id + "'";
    out.push_back("'" + chain.name + "' has begun and is not in the network" +
                  (committed.empty() ? "" : " (committed: " + committed + ")") +
                  "; leave it in, or send the network when it has ended");
  }
  return out;
}

Network PlannedNetwork::replace(Network next, const std::map<std::string, temporal::Value>& newest_values,
                                Time now) {
  const std::vector<model::TaskIndex> waiting = cycle_->waiting();
  Network before = std::exchange(network_, std::move(next));
  const flattening::Chains old_chains = std::exchange(chains_, flattening::flatten_all(network_));
  const std::unique_ptr<cycle::Cycle> old = std::move(cycle_);
  assessor_ = std::make_unique<assessor::SubwayAssessor>(network_, chains_);
  delivery_.replaced(before);
  begin(now);
  std::vector<Block> blocks;
  for (Block block : old->blocks()) {
    if (!block.begun()) continue;
    const auto* const same = counterpart(before, old_chains.chains[block.chain], network_, chains_);
    if (same == nullptr) continue;  // it is over
    block.chain = static_cast<std::uint32_t>(same - chains_.chains.data());
    for (std::size_t i = 0; i < block.links.size(); ++i) {
      Link& link = block.links[i];
      if (before.tasks[link.task].products != network_.tasks[same->links[i].task].products) link.generated = 0;
      link.task = same->links[i].task;
    }
    blocks.push_back(std::move(block));
  }
  const cycle::Past past = past_for(network_, before, *old, now);
  cycle_->resume(past, std::move(blocks), old->last_block(), now);
  for (std::uint32_t i = 0; i < network_.timelines.size(); ++i) {
    const auto& timeline = network_.timelines[i];
    if (!timeline.reported) continue;
    const auto newest = newest_values.find(timeline.name);
    if (newest == newest_values.end()) continue;
    const auto heard = number_of(timeline, newest->second);
    if (!heard) continue;
    const bool known =
        index_of(before.timelines, timeline.name, &temporal::timelines::Definition::name).has_value();
    cycle_->observe(i, now, known ? past.internal[i] : *heard);
  }
  for (const model::TaskIndex task : waiting)
    if (const auto same = index_of(network_.tasks, before.tasks[task].id, &model::Task::id);
        same && network_.tasks[*same].is_template)
      cycle_->still_requested(*same);
  return before;
}

}  // namespace roci::planner::utility_htn::adapter
