// What finds a place by search: requests that wait are scheduled (R79, R80), and what has not begun is planned anew
// where that is better (R101).
#include <algorithm>
#include <utility>

#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/search/anytime.hpp"
#include "planner_svc/utility_htn/search/robust.hpp"

namespace roci::planner::utility_htn::cycle {

using model::TaskIndex;
using temporal::Duration, temporal::Time;

namespace {

constexpr std::uint64_t kFirstPass = 64;  // entries; each pass takes twice as many

}  // namespace

search::Problem Cycle::problem_for(Time now, const std::set<TaskIndex>& candidates,
                                   std::span<const double> newest) {
  search::Problem problem{network_, past_.values, chains_, assessor_, scheduler_, timelines_};
  problem.from = now + network_.cycle.commit_window;
  problem.until = plan_end_;
  problem.budget = budget();
  problem.timelines_now = newest;
  problem.first_id = TaskId{1} << 63U;
  for (const Block* one : by_start()) {
    search::Placed standing{one->chain, {}};
    for (const Link& each : one->links) standing.starts.push_back(each.start);
    problem.committed.push_back(std::move(standing));
  }
  problem.closed = closed_but(candidates, now);
  problem.standing = data();
  if (delivery_ != nullptr) delivery_->join(problem, now);
  return problem;
}

// What earlier passes explored counts, too.
search::Outcome Cycle::search_in_passes(const search::Problem& problem, Report& report) const {
  search::Progress best = search::search_anytime(
      problem, {.first_entries = kFirstPass, .all_entries = network_.exploration_bound});
  report.notes.push_back("the best plan found has utility " + to_text(best.outcome.plan.utility) +
                         ", and none has more than " + to_text(best.bound) + " (gap " + to_text(best.gap) +
                         ")");
  best.outcome.statistics.entries = best.entries;
  return std::move(best.outcome);
}

Cycle::Found Cycle::plan_for(Time now, const std::set<TaskIndex>& candidates, Report& report,
                             const search::Plan* known) {
  const std::vector<double> newest = values_now(now);
  search::Problem problem = problem_for(now, candidates, newest);
  const auto beats = [](const auto& worth, double cost, const auto& known_worth, double known_cost) {
    return worth > known_worth || (worth == known_worth && cost < known_cost - 1e-6);
  };
  if (settings_.search != Search::robust) {
    search::Outcome outcome =
        settings_.search == Search::anytime ? search_in_passes(problem, report) : search::search(problem);
    report.explored += outcome.statistics.entries;
    searched_ = {.plan = {}, .complete = outcome.complete, .statistics = outcome.statistics};
    const search::Plan& plan = outcome.plan;
    const bool better = known == nullptr || beats(plan.utility, plan.cost, known->utility, known->cost);
    return {std::move(outcome.plan), better};
  }
  const search::RobustSettings judging;
  search::RobustOutcome robust = search::search_robust(problem, judging, network_.exploration_bound);
  report.explored += robust.explored;
  searched_ = {.plan = {}, .complete = robust.outcome.complete, .statistics = robust.outcome.statistics};
  const search::Candidate& chosen = robust.candidates[robust.chosen];
  const bool better = known == nullptr || beats(chosen.judged, chosen.plan.cost,
                                                search::judged(problem, *known, judging), known->cost);
  return {std::move(robust.outcome.plan), better};
}

bool Cycle::schedule(Time now, Report& report) {
  slide_window(now);
  if (!to_schedule_ || (scheduled_ && !settings_.schedules_again)) return false;
  to_schedule_ = false;
  scheduled_ = true;
  const std::set<TaskIndex> waiting_requests = candidates(now);
  if (waiting_requests.empty()) return false;
  const search::Plan plan = plan_for(now, waiting_requests, report).plan;
  adopt(plan);
  return !plan.placed.empty();
}

void Cycle::adopt(const search::Plan& plan) {
  for (const search::Placed& placed : plan.placed) {
    Block added{++last_block_, placed.chain, {}};
    const auto& links = chains_.chains[placed.chain].links;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Duration length = duration(links[i].task);
      added.links.push_back(
          {links[i].task, placed.starts[i], placed.starts[i], placed.starts[i] + length, Stage::planned});
    }
    put_in(added);
    blocks_.push_back(std::move(added));
  }
}

temporal::RankVector Cycle::predicted(std::uint32_t chain, std::span<const double> newest,
                                      std::span<const std::uint32_t> before,
                                      std::span<const TaskIndex> closed) const {
  const auto existing =
      delivery_ != nullptr ? delivery_->products() : std::span<const assessor::ExistingProduct>{};
  return assessor_.predicted(chain, {network_, past_.values, chains_, newest, existing, before, closed});
}

// Returns what has not begun as a plan, assessed as a search assesses its own.
search::Plan Cycle::planned(Time now) const {
  const std::vector<double> newest = values_now(now);
  const std::vector<TaskIndex> closed = this->closed(now);
  std::vector<std::uint32_t> before;
  search::Plan out;
  for (const Block* one : by_start()) {
    if (!one->begun()) {
      out.utility += predicted(one->chain, newest, before, closed);
      out.cost += flattening::cost(network_, chains_.chains[one->chain], past_.values);
      search::Placed standing{one->chain, {}};
      for (const Link& each : one->links) standing.starts.push_back(each.start);
      out.placed.push_back(std::move(standing));
    }
    before.push_back(one->chain);
  }
  return out;
}

// Plans all anew that has not begun, and changes the plan only for a better one (R101).
bool Cycle::optimize(Time now, Report& report) {
  if (!to_optimize_) return false;
  to_optimize_ = false;
  observations_.forget_deviations();
  const search::Plan old = planned(now);
  std::vector<Block> before;
  for (const Block& one : blocks_)
    if (!one.begun()) before.push_back(one);
  for (const Block& one : before) take_out(one);
  std::erase_if(blocks_, [](const Block& one) { return !one.begun(); });
  const Found found = plan_for(now, candidates(now), report, &old);
  if (found.better) {
    adopt(found.plan);
    return true;
  }
  for (Block& one : before) {
    put_in(one);
    blocks_.push_back(std::move(one));
  }
  std::ranges::sort(blocks_, {}, &Block::number);
  return false;
}

}  // namespace roci::planner::utility_htn::cycle
