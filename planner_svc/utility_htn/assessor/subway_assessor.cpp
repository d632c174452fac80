#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"

#include <algorithm>
#include <map>
#include <set>

namespace roci::planner::utility_htn::assessor {

using flattening::Chain;
using model::Subtask, model::TaskIndex;
using temporal::RankVector;

namespace {

RankVector at_rank(std::size_t rank, double score) {
  std::vector<double> scores(rank + 1, 0.0);
  scores[rank] = score;
  return RankVector(std::move(scores));
}

bool holds(const Chain& chain, TaskIndex task) {
  return std::ranges::any_of(chain.links, [task](const Subtask& link) { return link.task == task; });
}

}  // namespace

SubwayAssessor::SubwayAssessor(const model::Network& network, const flattening::Chains& chains) {
  const auto& sites = network.subway.sites;
  std::map<TaskIndex, Stop> stops;
  for (std::uint32_t site = 0; site < sites.size(); ++site) {
    for (std::uint32_t target = 0; target < sites[site].targets.size(); ++target)
      stops[sites[site].targets[target].task] = {site, target};
  }

  for (const Chain& chain : chains.chains) {
    const auto found = stops.find(chain.task);
    stops_.push_back(found == stops.end() ? std::nullopt : std::optional(found->second));
  }
  find_openers(network, chains);

  constexpr std::uint32_t kNoSite = static_cast<std::uint32_t>(-1);
  constexpr std::uint32_t kOpener = static_cast<std::uint32_t>(-1);
  std::map<TaskIndex, std::set<std::pair<std::uint32_t, std::uint32_t>>> holders;
  for (std::size_t index = 0; index < chains.chains.size(); ++index) {
    const Chain& chain = chains.chains[index];
    std::pair<std::uint32_t, std::uint32_t> by{kNoSite, chain.task};
    if (stops_[index]) by = {stops_[index]->site, stops_[index]->target};
    if (opens_[index]) by = {*opens_[index], kOpener};
    for (const Subtask& link : chain.links) holders[link.task].insert(by);
  }
  supporting_.resize(sites.size());
  for (const auto& [task, by] : holders) {
    const std::uint32_t site = by.begin()->first;
    const bool of_one_site = site != kNoSite && by.rbegin()->first == site;
    if (of_one_site && (by.size() >= 2 || by.begin()->second == kOpener)) supporting_[site].push_back(task);
  }
}

void SubwayAssessor::find_openers(const model::Network& network, const flattening::Chains& chains) {
  opens_.resize(chains.chains.size());
  if (network.subway.sites.size() < 2) return;
  using temporal::timelines::Index;
  std::map<Index, std::set<std::uint32_t>> sites_waiting;  // by timeline
  for (std::size_t index = 0; index < chains.chains.size(); ++index) {
    if (!stops_[index]) continue;
    for (const auto& constraint : chains.chains[index].when)
      sites_waiting[constraint.timeline].insert(stops_[index]->site);
    for (const Subtask& link : chains.chains[index].links) {
      for (const auto& constraint : network.tasks[link.task].constraints)
        sites_waiting[constraint.timeline].insert(stops_[index]->site);
    }
  }
  for (std::size_t index = 0; index < chains.chains.size(); ++index) {
    if (stops_[index]) continue;
    std::set<std::uint32_t> opened;
    for (const Subtask& link : chains.chains[index].links) {
      for (const model::Impact& impact : network.tasks[link.task].impacts) {
        const auto found = sites_waiting.find(impact.timeline);
        if (found != sites_waiting.end() && found->second.size() == 1) opened.insert(*found->second.begin());
      }
    }
    if (opened.size() == 1) opens_[index] = *opened.begin();
  }
}

RankVector SubwayAssessor::predicted(std::uint32_t chain, const Context& context) const {
  const Chain& links = context.chains.chains.at(chain);
  if (!stops_.at(chain)) {
    const RankVector worth = flattening::utility(context.network, links, context.values);
    return opens_[chain] ? opening(chain, context, worth, state(context).next()) : worth;
  }
  const SubwayState map = state(context);
  return sampling(chain, context, own_worth(links, context, map.estimated(*stops_[chain])), map.next());
}

// Returns what a chain is worth that opens a site, where the map leads to `next`.
RankVector SubwayAssessor::opening(std::uint32_t chain, const Context& context, const RankVector& worth,
                                   const std::optional<Stop>& next) const {
  const std::size_t rank = context.network.subway.rank;
  return next && next->site == *opens_[chain] ? worth : worth + at_rank(rank, -1.0 - worth[rank]);
}

// Returns what a chain is worth that samples a target, and is worth `own` by itself.
RankVector SubwayAssessor::sampling(std::uint32_t chain, const Context& context, const RankVector& own,
                                    const std::optional<Stop>& next) const {
  const std::size_t rank = context.network.subway.rank;
  const RankVector out = own + support(chain, stops_[chain]->site, context);
  return out + at_rank(rank, (next == stops_[chain] ? 1.0 : -1.0) - out[rank]);
}

// What does not depend on what is planned is looked at once: values and signatures,
// and so what a chain is worth by itself.
class SubwayAssessor::MapForecast final : public Forecast {
 public:
  MapForecast(const SubwayAssessor& assessor, const Context& context)
      : assessor_(assessor),
        context_(context),
        nothing_planned_(assessor.state({context.network,
                                         context.values,
                                         context.chains,
                                         context.timelines_now,
                                         context.products,
                                         {},
                                         context.closed})),
        map_(nothing_planned_),
        own_(assessor.stops_.size()) {}

  void plan(std::span<const std::uint32_t> planned) override {
    planned_.clear();
    map_ = nothing_planned_;
    for (const std::uint32_t chain : planned) add(chain);
    next_ = map_.next();
  }
  void plan_next(std::uint32_t chain) override {
    add(chain);
    next_ = map_.next();
  }

  RankVector predicted(std::uint32_t chain) const override {
    const auto& stop = assessor_.stops_[chain];
    const auto& opens = assessor_.opens_[chain];
    const bool led_elsewhere = stop ? next_ != stop : opens && (!next_ || next_->site != *opens);
    if (led_elsewhere && context_.network.subway.rank == 0) return {-1.0};
    if (!own_[chain]) own_[chain] = own_worth(chain);
    if (!stop) return opens ? assessor_.opening(chain, context_, *own_[chain], next_) : *own_[chain];
    return assessor_.sampling(chain,
                              {context_.network, context_.values, context_.chains, context_.timelines_now,
                               context_.products, planned_, context_.closed},
                              *own_[chain], next_);
  }

 private:
  void add(std::uint32_t chain) {
    planned_.push_back(chain);
    if (assessor_.stops_[chain]) map_.plan(*assessor_.stops_[chain]);
  }
  RankVector own_worth(std::uint32_t chain) const {
    const Chain& links = context_.chains.chains[chain];
    const auto& stop = assessor_.stops_[chain];
    return stop ? assessor_.own_worth(links, context_, nothing_planned_.estimated(*stop))
                : flattening::utility(context_.network, links, context_.values);
  }

  const SubwayAssessor& assessor_;
  Context context_;
  SubwayState nothing_planned_;  // what is estimated depends on signatures alone
  SubwayState map_;
  std::optional<Stop> next_;
  std::vector<std::uint32_t> planned_;
  mutable std::vector<std::optional<RankVector>> own_;  // by chain
};

std::unique_ptr<Forecast> SubwayAssessor::forecast(const Context& context) const {
  auto out = std::make_unique<MapForecast>(*this, context);
  out->plan(context.planned);
  return out;
}

RankVector SubwayAssessor::most(std::uint32_t chain, const Context& context) const {
  const Chain& links = context.chains.chains.at(chain);
  if (!stops_.at(chain)) return flattening::utility(context.network, links, context.values);
  const RankVector sure = own_worth(links, context, 1.0);
  const RankVector hopeless = own_worth(links, context, 0.0);
  RankVector supported;
  for (const TaskIndex task : supporting_[stops_[chain]->site]) {
    if (holds(links, task)) continue;
    const RankVector planned = model::utility(context.network.tasks[task], context.values);
    RankVector existing;
    for (const ExistingProduct& product : context.products) {
      if (product.task == task) existing += executed(product, context);
    }
    for (std::size_t rank = 0; rank < std::max(planned.scores().size(), existing.scores().size()); ++rank)
      supported += at_rank(rank, std::max({0.0, planned[rank], existing[rank]}));
  }
  RankVector out;
  const std::size_t ranks =
      std::max({sure.scores().size(), hopeless.scores().size(), supported.scores().size(),
                std::size_t{context.network.subway.rank} + 1});
  for (std::size_t rank = 0; rank < ranks; ++rank) {
    const bool of_map = rank == context.network.subway.rank;
    out += at_rank(rank, of_map ? 1.0 : std::max(sure[rank], hopeless[rank]) + supported[rank]);
  }
  return out;
}

bool SubwayAssessor::contextual(std::uint32_t chain, const Context&) const {
  return stops_.at(chain).has_value() || opens_[chain].has_value();
}

std::string SubwayAssessor::objection(std::uint32_t chain, const Context& context) const {
  if (!contextual(chain, context)) return {};
  const std::optional<Stop> next = state(context).next();
  if (next && (opens_[chain] ? next->site == *opens_[chain] : next == stops_[chain])) return {};
  const auto& sites = context.network.subway.sites;
  const std::string asked = "the subway map does not lead to '" +
                            context.network.tasks[context.chains.chains[chain].task].id + "': ";
  const auto id_of = [&](Stop stop) -> const std::string& {
    return context.network.tasks[sites[stop.site].targets[stop.target].task].id;
  };
  return next ? asked + "after what is planned it leads to '" + id_of(*next) + "'"
              : asked + "every site is finished";
}

SubwayState SubwayAssessor::state(const Context& context) const {
  SubwayState out(context.network.subway, context.values, context.timelines_now);
  const auto& sites = context.network.subway.sites;
  for (const TaskIndex request : context.closed) {
    for (std::uint32_t site = 0; site < sites.size(); ++site) {
      for (std::uint32_t target = 0; target < sites[site].targets.size(); ++target) {
        if (sites[site].targets[target].task == request) out.close({site, target});
      }
    }
  }
  for (const std::uint32_t chain : context.planned) {
    if (stops_.at(chain)) out.plan(*stops_[chain]);
  }
  return out;
}

// What the chain's own tasks are worth; only what is not sent is weighted,
// since communication utility is constant (section II.C).
RankVector SubwayAssessor::own_worth(const Chain& chain, const Context& context, double estimated) const {
  const std::size_t weighted = std::size_t{context.network.subway.rank} + 1;
  RankVector out;
  for (const Subtask& link : chain.links) {
    const model::Task& task = context.network.tasks[link.task];
    const RankVector worth = model::utility(task, context.values);
    out += worth;
    if (!task.downlinks) out += at_rank(weighted, (estimated - 1.0) * worth[weighted]);
  }
  return out;
}

RankVector SubwayAssessor::support(std::uint32_t chain, std::uint32_t site, const Context& context) const {
  RankVector out;
  for (const TaskIndex task : supporting_[site]) {
    if (holds(context.chains.chains[chain], task)) continue;
    bool exists = false;
    for (const ExistingProduct& product : context.products) {
      if (product.task != task) continue;
      out += executed(product, context);
      exists = true;
    }
    const auto plans_it = [&](std::uint32_t planned) { return holds(context.chains.chains[planned], task); };
    if (!exists && std::ranges::any_of(context.planned, plans_it))
      out += model::utility(context.network.tasks[task], context.values);
  }
  return out;
}

}  // namespace roci::planner::utility_htn::assessor
