#include "tests/unit/planner_svc/utility_htn/search/brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

namespace roci::planner::utility_htn::search {

using temporal::ImpactKind, temporal::ImpactWhen, temporal::RankVector, temporal::seconds;
using temporal::timelines::Timelines;

namespace {

// Links written out once more, from the network alone.
std::vector<Link> links_of(const Problem& problem, std::uint32_t index) {
  const flattening::Chain& chain = problem.chains.chains[index];
  std::vector<Link> out;
  for (std::size_t at = 0; at < chain.links.size(); ++at) {
    const model::Task& task = problem.network.tasks[chain.links[at].task];
    Link link;
    link.id = problem.first_id + 65536ULL * index + at;
    link.footprint = model::footprint(task, problem.values);
    if (at == 0)
      link.footprint.constraints.insert(link.footprint.constraints.end(), chain.when.begin(),
                                        chain.when.end());
    link.shortest_gap = chain.links[at].shortest_gap;
    link.longest_gap = chain.links[at].longest_gap;
    link.starts = {std::max(problem.from, task.opens),
                   temporal::plus(std::min(task.closes, problem.until), -link.footprint.duration)};
    out.push_back(link);
  }
  return out;
}

RankVector billionths(const RankVector& utility) {
  std::vector<double> scores = utility.scores();
  for (double& score : scores) score = std::round(score * 1e9) / 1e9;
  return RankVector(std::move(scores));
}

}  // namespace

Plan best_by_brute_force(const Problem& problem, std::vector<double>& most) {
  Plan best;
  most.assign(8, 0.0);
  std::set<model::TaskIndex> used;
  const std::function<void(const Plan&, const Timelines&)> extend = [&](const Plan& plan,
                                                                        const Timelines& lines) {
    for (std::uint32_t index = 0; index < problem.chains.chains.size(); ++index) {
      const flattening::Chain& chain = problem.chains.chains[index];
      const double cost = plan.cost + flattening::cost(problem.network, chain, problem.values);
      if (used.contains(chain.task) || std::round(cost * 1e9) >= std::round(problem.budget * 1e9)) continue;
      Timelines after = lines;
      const auto starts = problem.scheduler.schedule(links_of(problem, index), after);
      if (!starts) continue;
      Plan next = plan;
      next.placed.push_back({index, *starts});
      next.cost = cost;
      std::ranges::sort(next.placed, {},
                        [](const Placed& placed) { return std::pair(placed.starts.front(), placed.chain); });
      next.utility = {};
      std::vector<std::uint32_t> before;
      bool allowed = true;
      for (const Placed& placed : next.placed) {
        const assessor::Context context{problem.network,       problem.values,   problem.chains,
                                        problem.timelines_now, problem.products, before,
                                        problem.closed};
        const RankVector utility = problem.assessor.predicted(placed.chain, context);
        allowed = allowed && !(utility < RankVector{});
        next.utility += utility;
        before.push_back(placed.chain);
      }
      if (!allowed) continue;
      next.utility = billionths(next.utility);
      for (std::size_t rank = 0; rank < most.size(); ++rank)
        most[rank] = std::max(most[rank], next.utility[rank]);
      if (next.utility > best.utility || (next.utility == best.utility && next.cost < best.cost - 1e-6))
        best = next;
      used.insert(chain.task);
      extend(next, after);
      used.erase(chain.task);
    }
  };
  extend({}, problem.anchored);
  return best;
}

void draw(std::mt19937_64& random, Toy& toy, bool sites) {
  const auto up_to = [&](unsigned bound) { return static_cast<unsigned>(random() % (bound + 1)); };
  const auto scores = [&] { return std::vector<double>{0.1 * up_to(3), 0.1 * up_to(9), 0.1 * up_to(9)}; };
  const auto primitive = [&](const std::string& id) {
    const model::TaskIndex index =
        toy.task(id, 10 + 10 * up_to(3), 20 * up_to(10), scores(), up_to(1) == 0, true);
    model::Task& task = toy[index];
    if (up_to(3) == 0) task.opens = seconds(10 * up_to(8));
    if (up_to(2) == 0) task.closes = seconds(60 + 10 * up_to(12));
    if (up_to(5) == 0)
      task.impacts.push_back(
          {Toy::kPhase, ImpactKind::assign, ImpactWhen::at_end, {double(up_to(2)), {}, 1}});
    if (up_to(5) == 0)
      task.constraints.push_back(
          {Toy::kPhase, temporal::timelines::Phase::pre, -INFINITY, INFINITY, 1ULL << up_to(2)});
    return index;
  };
  const std::size_t requests = sites ? 4 : 3 + up_to(1);
  std::vector<std::uint32_t> dug;
  for (std::uint32_t site = 0; sites && site < 2; ++site) {
    dug.push_back(static_cast<std::uint32_t>(toy.network.timelines.size()));
    toy.network.timelines.push_back({"dug_" + std::to_string(site),
                                     temporal::timelines::Kind::state,
                                     {"no", "yes"},
                                     0,
                                     -INFINITY,
                                     INFINITY,
                                     false});
    toy.network.subway.sites.push_back({"site", {0.1 * up_to(9), {}, 1}, {}});
  }
  for (std::size_t request = 0; request < requests; ++request) {
    const std::string name = "r" + std::to_string(request);
    const std::size_t ways = 1 + up_to(1);
    std::vector<std::vector<model::TaskIndex>> decompositions;
    for (std::size_t way = 0; way < (sites ? 2 : ways); ++way) {
      std::vector<model::TaskIndex>& tasks = decompositions.emplace_back();
      for (std::size_t link = 0; link < 1 + up_to(1); ++link)
        tasks.push_back(primitive(name + "." + std::to_string(way) + "." + std::to_string(link)));
    }
    const std::uint32_t site = request % 2;
    if (sites) {  // the first way digs, the second waits until somebody has dug
      model::TaskIndex dig = toy.task(name + ".dig", 10, 50 + 20 * up_to(10), scores(), true, true);
      toy[dig].impacts.push_back({dug[site], ImpactKind::assign, ImpactWhen::at_end, {1, {}, 1}});
      decompositions[0].insert(decompositions[0].begin(), dig);
    }
    const model::TaskIndex parent = toy.parent(name, decompositions);
    if (sites) {
      toy[parent].decompositions[1].when = {
          {dug[site], temporal::timelines::Phase::pre, -INFINITY, INFINITY, 2}};
      toy.network.subway.sites[site].targets.push_back(
          {parent, static_cast<std::uint32_t>(toy.network.timelines.size()), {0.1 * up_to(9), {}, 1}});
      toy.network.timelines.push_back(
          {"signature", temporal::timelines::Kind::state, {"unknown", "negative", "positive"}});
      toy.network.timelines.back().name += name;
    }
    for (model::Decomposition& way : toy[parent].decompositions) {
      for (model::Subtask& subtask : way.subtasks) {
        subtask.shortest_gap = seconds(5 * up_to(1));
        if (up_to(2) == 0) subtask.longest_gap = subtask.shortest_gap + seconds(10 * up_to(3));
      }
    }
  }
}

}  // namespace roci::planner::utility_htn::search
