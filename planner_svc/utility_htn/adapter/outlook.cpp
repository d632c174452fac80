#include "planner_svc/utility_htn/adapter/outlook.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"
#include "planner_svc/utility_htn/assessor/subway_map.hpp"

namespace roci::planner::utility_htn::adapter {

using cycle::Block, cycle::Link, cycle::Stage;
using engine::ChainOutlook, engine::ChainStage, engine::MissionOutlook, engine::ScheduledProduct;
using temporal::RankVector, temporal::Time;

namespace {

engine::DataTier tier_of(model::Tier tier) { return static_cast<engine::DataTier>(tier); }

ScheduledProduct scheduled(const std::string& id, const delivery::Schedule& schedule) {
  const auto known = schedule.products.find(id);
  if (known == schedule.products.end()) return {id, false, 0, engine::DataTier::mandatory};
  return {id, known->second.exists, known->second.bytes, tier_of(known->second.tier)};
}

const Link* link_of(const cycle::Cycle& cycle, cycle::TaskId id) {
  const auto block = std::ranges::find(cycle.blocks(), cycle::block_of(id), &Block::number);
  if (block == cycle.blocks().end() || cycle::link_of(id) >= block->links.size()) return nullptr;
  return &block->links[cycle::link_of(id)];
}

std::vector<const Block*> by_start(const cycle::Cycle& cycle) {
  std::vector<const Block*> out;
  for (const Block& one : cycle.blocks()) out.push_back(&one);
  std::ranges::stable_sort(out, {}, [](const Block* one) { return one->links.front().start; });
  return out;
}

std::vector<double> values_now(const Situation& at) {
  std::vector<double> out;
  for (temporal::timelines::Index i = 0; i < at.network.timelines.size(); ++i)
    out.push_back(at.cycle.timelines().value(i, at.now));
  return out;
}

ChainStage stage_of(const Block& block) {
  if (block.failed()) return ChainStage::failed;
  if (block.over()) return ChainStage::done;
  const auto any = [&](Stage stage) {
    return std::ranges::find(block.links, stage, &Link::stage) != block.links.end();
  };
  if (any(Stage::running) || any(Stage::succeeded)) return ChainStage::running;
  return any(Stage::committed) ? ChainStage::committed : ChainStage::planned;
}

ChainOutlook outlook_of(const Situation& at, const Block& block, RankVector predicted) {
  const flattening::Chain& chain = at.chains.chains[block.chain];
  const model::Task& task = at.network.tasks[chain.task];
  ChainOutlook out;
  out.request = task.id;
  out.title = task.name.empty() ? task.id : task.name;
  out.chain = chain.name;
  out.block = block.number;
  out.stage = stage_of(block);
  out.start = block.links.front().start;
  out.end = out.start;
  for (const Link& each : block.links)
    if (each.stage != Stage::doomed) out.end = std::max(out.end, each.end);
  out.predicted = std::move(predicted);
  out.cost_j = flattening::cost(at.network, chain, at.cycle.past().values);
  return out;
}

void add_products(const Situation& at, MissionOutlook& out) {
  for (const delivery::Existing& one : at.delivery.existing()) {
    engine::ProductOutlook& added = out.products.emplace_back();
    added.data = {one.data.id, true, one.data.bytes, tier_of(one.data.tier)};
    if (one.request < at.network.tasks.size()) added.request = at.network.tasks[one.request].id;
    added.fate = static_cast<engine::DataFate>(one.fate);
    added.predicted = one.predicted;
    added.executed = one.data.utility;
  }
  for (const model::DataProduct& one : at.cycle.data().products) {
    if (one.created <= at.now) continue;
    engine::ProductOutlook& added = out.products.emplace_back();
    added.data = {one.id, false, one.bytes, tier_of(one.tier)};
    added.request = one.id.substr(0, one.id.find('/'));
    added.predicted = one.utility;
  }
}

void add_energy(const Situation& at, MissionOutlook& out) {
  const auto& budget = at.network.timelines[at.network.budget];
  out.budget = budget.name;
  out.capacity_j = budget.highest;
  const auto& timelines = at.cycle.timelines();
  const double now = timelines.value(at.network.budget, at.now);
  std::map<Time, std::string> ends{{at.now, ""}};  // and starts, with the task that ends then
  for (const Block& block : at.cycle.blocks())
    for (std::size_t i = 0; i < block.links.size(); ++i) {
      const Link& each = block.links[i];
      if (each.end <= at.now || cycle::is_over(each.stage) || each.stage == Stage::doomed) continue;
      if (each.start > at.now) ends.try_emplace(each.start);
      std::string& ending = ends[each.end];
      if (ending.empty()) ending = activity_id(at.network, each, cycle::task_id(block.number, i));
    }
  const auto bounded = [&](double value) { return std::clamp(value, budget.lowest, budget.highest); };
  for (const auto& [end, activity] : ends) {
    const double spent = now - timelines.value(at.network.budget, end);
    out.energy.push_back({end, activity, bounded(now - spent), bounded(now - Outlooks::kWorst * spent),
                          bounded(now - Outlooks::kBest * spent)});
  }
}

void add_subway(const Situation& at, MissionOutlook& out) {
  const auto& map = at.network.subway;
  if (map.sites.empty()) return;
  const std::vector<double> now = values_now(at);
  const std::vector<model::TaskIndex> closed = at.cycle.closed(at.now);
  const std::set<model::TaskIndex> gone(closed.begin(), closed.end());
  std::set<model::TaskIndex> planned;
  for (const Block& one : at.cycle.blocks()) planned.insert(at.chains.chains[one.chain].task);
  const model::Values& values = at.cycle.past().values;
  assessor::SubwayState state(map, values, now);
  for (std::uint32_t s = 0; s < map.sites.size(); ++s)
    for (std::uint32_t t = 0; t < map.sites[s].targets.size(); ++t) {
      const model::TaskIndex task = map.sites[s].targets[t].task;
      if (gone.contains(task)) state.close({s, t});
      if (planned.contains(task)) state.plan({s, t});
    }
  out.most_samples = map.most_samples;
  for (std::uint32_t s = 0; s < map.sites.size(); ++s) {
    const model::Site& site = map.sites[s];
    engine::SubwaySite& line = out.sites.emplace_back();
    line.name = site.name;
    line.by_vision = std::clamp(model::evaluate(site.value, values), 0.0, 1.0);
    line.chance = state.chance(s);
    for (std::uint32_t t = 0; t < site.targets.size(); ++t) {
      const model::Target& target = site.targets[t];
      const auto outcome = static_cast<std::size_t>(now[target.signature]);
      line.targets.push_back({at.network.tasks[target.task].id,
                              static_cast<engine::SignatureOutcome>(std::min<std::size_t>(outcome, 2)),
                              std::clamp(model::evaluate(target.visual, values), 0.0, 1.0),
                              state.estimated({s, t}), planned.contains(target.task),
                              gone.contains(target.task)});
    }
  }
  std::ranges::stable_sort(out.sites, std::greater{}, &engine::SubwaySite::chance);
  if (const auto next = state.next())
    out.next_target = at.network.tasks[map.sites[next->site].targets[next->target].task].id;
}

}  // namespace

engine::DownlinkSchedule schedule_of(const Situation& at) {
  engine::DownlinkSchedule out;
  out.ranks = ranks_of(at.network);
  out.limited = at.delivery.limited();
  if (!out.limited) return out;
  const delivery::Schedule schedule = at.delivery.schedule(at.cycle.data(), at.cycle.past().values, at.now);
  for (const delivery::Downlink& one : schedule.downlinks) {
    const Link* const link = link_of(at.cycle, one.id);
    engine::ScheduledDownlink& added = out.downlinks.emplace_back();
    added.activity = link != nullptr ? activity_id(at.network, *link, one.id) : at.network.tasks[one.task].id;
    added.start = one.start;
    added.end = one.end;
    added.bytes = one.bytes;
    added.takes = one.takes;
    added.energy_j = one.energy_j;
    for (const std::string& id : one.products) added.products.push_back(scheduled(id, schedule));
  }
  for (const delivery::Unsent& one : schedule.left_out)
    out.left_out.push_back({scheduled(one.product, schedule), one.why});
  for (const delivery::Unsent& one : schedule.late)
    out.late.push_back({scheduled(one.product, schedule), one.why});
  return out;
}

std::map<cycle::TaskId, std::vector<std::string>> products_by_task(const engine::DownlinkSchedule& schedule) {
  std::map<cycle::TaskId, std::vector<std::string>> out;
  for (const engine::ScheduledDownlink& one : schedule.downlinks)
    if (const auto task = task_of(one.activity))
      for (const ScheduledProduct& product : one.products) out[*task].push_back(product.id);
  return out;
}

void Outlooks::forgotten(const Situation& after, const std::vector<Block>& begun_before) {
  for (const Block& before : begun_before) {
    if (std::ranges::find(after.cycle.blocks(), before.number, &Block::number) != after.cycle.blocks().end())
      continue;
    auto predicted = predicted_.extract(before.number);
    ended_.push_back(outlook_of(after, before,
                                predicted
                                    ? predicted.mapped()
                                    : flattening::utility(after.network, after.chains.chains[before.chain],
                                                          after.cycle.past().values)));
    if (!before.over()) ended_.back().stage = ChainStage::failed;
  }
  if (ended_.size() > kMostEnded)
    ended_.erase(ended_.begin(), ended_.end() - static_cast<std::ptrdiff_t>(kMostEnded));
  std::erase_if(predicted_, [&](const auto& one) {
    return std::ranges::find(after.cycle.blocks(), one.first, &Block::number) == after.cycle.blocks().end();
  });
}

// Each chain in the context of those that start before it, as the cycle assesses its plan.
void Outlooks::add_chains(const Situation& at, MissionOutlook& out) {
  out.chains = ended_;
  const std::vector<double> now = values_now(at);
  const std::vector<model::TaskIndex> closed = at.cycle.closed(at.now);
  const model::Values& values = at.cycle.past().values;
  std::vector<std::uint32_t> before;
  for (const Block* const one : by_start(at.cycle)) {
    if (!one->begun()) {
      const assessor::Context context{at.network, values, at.chains, now, at.delivery.products(),
                                      before,     closed};
      predicted_[one->number] = at.assessor.predicted(one->chain, context);
    }
    const auto known = predicted_.find(one->number);
    out.chains.push_back(outlook_of(
        at, *one,
        known != predicted_.end() ? known->second
                                  : flattening::utility(at.network, at.chains.chains[one->chain], values)));
    before.push_back(one->chain);
  }
  // Data count for the newest try of the request of which they come.
  std::map<std::string_view, ChainOutlook*> newest;
  for (ChainOutlook& chain : out.chains) {
    ChainOutlook*& known = newest[chain.request];
    if (known == nullptr || known->block < chain.block) known = &chain;
  }
  for (const delivery::Existing& data : at.delivery.existing()) {
    if (data.request >= at.network.tasks.size()) continue;
    const auto chain = newest.find(at.network.tasks[data.request].id);
    if (chain != newest.end()) chain->second->executed += data.data.utility;
  }
  std::ranges::stable_sort(out.chains, {}, &ChainOutlook::start);
}

MissionOutlook Outlooks::make(const Situation& at) {
  MissionOutlook out;
  out.ranks = ranks_of(at.network);
  out.received = at.delivery.received();
  add_chains(at, out);
  add_products(at, out);
  add_energy(at, out);
  add_subway(at, out);
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
