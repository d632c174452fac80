#include "planner_svc/utility_htn/search/search.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "planner_svc/utility_htn/search/chain_table.hpp"
#include "planner_svc/utility_htn/search/exploration.hpp"
#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using model::TaskIndex;
using temporal::RankVector, temporal::Time;

namespace {

// One run over all phases. What is found stands on the timelines until the run is gone.
class OuterLoop {
 public:
  OuterLoop(const Problem& problem, std::uint64_t entries)
      : problem_(problem), entries_(entries), table_(problem), begin_(problem.anchored.mark()) {}
  OuterLoop(const OuterLoop&) = delete;
  OuterLoop& operator=(const OuterLoop&) = delete;
  ~OuterLoop() { problem_.anchored.undo(begin_); }

  Outcome run() {
    out_.complete = true;
    place_fixed();
    for (const std::vector<std::uint32_t>& batch : problem_.chains.by_batch) explore(batch);
    out_.statistics.bytes += table_.bytes();
    return std::move(out_);
  }

 private:
  // Fixed requests go by their time; of several chains of one, the first that fits is taken.
  void place_fixed() {
    std::vector<std::pair<Time, std::uint32_t>> order;
    for (std::uint32_t chain = 0; chain < problem_.chains.chains.size(); ++chain) {
      if (!table_.open(chain) || !table_.fixed(chain)) continue;
      order.emplace_back(fixed_time(chain), chain);
    }
    std::ranges::sort(order);
    std::vector<bool> placed(problem_.network.tasks.size());
    for (const auto& [time, chain] : order) {
      const TaskIndex request = table_.chain(chain).task;
      if (!placed[request]) placed[request] = place(chain);
    }
    for (const auto& [time, chain] : order) {
      if (!placed[table_.chain(chain).task]) out_.missed.push_back(chain);
    }
  }

  Time fixed_time(std::uint32_t chain) {
    Time first = temporal::no_bound;
    for (const Link& link : table_.links(chain)) {
      if (link.starts.earliest >= link.starts.latest) first = std::min(first, link.starts.earliest);
    }
    return first;
  }

  bool place(std::uint32_t chain) {
    Plan& plan = out_.plan;
    const double cost = rounded(plan.cost + table_.cost(chain));
    if (cost >= problem_.budget) return false;
    const std::size_t mark = problem_.anchored.mark();
    std::optional<std::vector<Time>> starts =
        problem_.scheduler.schedule(table_.links(chain), problem_.anchored);
    if (!starts) return false;
    const RankVector utility = table_.predicted(chain, by_start(problem_.committed, plan.placed));
    if (refused(utility)) {
      problem_.anchored.undo(mark);
      return false;
    }
    plan.placed.push_back({chain, std::move(*starts)});
    plan.utility = rounded(plan.utility + utility);
    plan.cost = cost;
    return true;
  }

  void explore(const std::vector<std::uint32_t>& batch) {
    Plan best;
    {
      Exploration exploration(problem_, table_, out_.plan, batch);
      out_.statistics.first_pairs += exploration.first_pairs();
      ++out_.statistics.nodes;
      out_.complete = exploration.run(entries_, out_.statistics) && out_.complete;
      out_.statistics.bytes = std::max(out_.statistics.bytes, exploration.bytes());
      best = exploration.best();
    }
    hold(best);
  }

  // Puts what the batch added onto the timelines, for the batches to come.
  void hold(const Plan& best) {
    for (const Placed& placed : best.placed) {
      if (std::ranges::find(out_.plan.placed, placed) != out_.plan.placed.end()) continue;
      const std::span<const Link> links = table_.links(placed.chain);
      for (std::size_t link = 0; link < links.size(); ++link)
        problem_.anchored.place(links[link].id, links[link].footprint, placed.starts[link]);
    }
    out_.plan = best;
  }

  const Problem& problem_;
  std::uint64_t entries_;
  ChainTable table_;
  std::size_t begin_;
  Outcome out_;
};

}  // namespace

Outcome search(const Problem& problem, std::uint64_t entries) { return OuterLoop(problem, entries).run(); }

Outcome search(const Problem& problem) { return search(problem, problem.network.exploration_bound); }

}  // namespace roci::planner::utility_htn::search
