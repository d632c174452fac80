#include "planner_svc/utility_htn/search/robust.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/temporal/value.hpp"
#include "planner_svc/utility_htn/search/chain_table.hpp"
#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using temporal::RankVector;

namespace {

RankVector scored(const Problem& problem, const ChainTable& table, const Plan& plan, double factor) {
  std::vector<std::uint32_t> order = by_start(problem.committed, {});
  std::vector<Placed> run;
  RankVector sum;
  double cost = 0;
  for (const Placed& placed : plan.placed) {
    cost += factor * table.cost(placed.chain);
    if (rounded(cost) >= problem.budget) break;
    order = by_start(problem.committed, run);
    sum += table.predicted(placed.chain, order);
    run.push_back(placed);
  }
  return rounded(sum);
}

RankVector judged(const std::vector<RankVector>& scores, Judgement judgement) {
  if (judgement == Judgement::worst)
    return *std::ranges::min_element(scores, [](const RankVector& a, const RankVector& b) { return a < b; });
  RankVector sum;
  for (const RankVector& score : scores) sum += score;
  return rounded(sum * (1.0 / static_cast<double>(scores.size())));
}

std::string decimal(double value) { return temporal::to_text(temporal::Value{value}); }

}  // namespace

RankVector score_under(const Problem& problem, const Plan& plan, double factor) {
  return scored(problem, ChainTable(problem), plan, factor);
}

RankVector judged(const Problem& problem, const Plan& plan, const RobustSettings& settings) {
  const ChainTable table(problem);
  std::vector<RankVector> scores;
  for (const double factor : settings.factors) scores.push_back(scored(problem, table, plan, factor));
  return judged(scores, settings.judgement);
}

RobustOutcome search_robust(const Problem& problem, const RobustSettings& settings, std::uint64_t entries) {
  if (settings.factors.empty())
    throw std::invalid_argument("a robust search needs at least one factor of energy, as 1");
  for (const double factor : settings.factors) {
    if (!(factor > 0))
      throw std::invalid_argument("a factor of energy is above 0, and not " + decimal(factor));
  }
  const ChainTable table(problem);
  RobustOutcome out;
  std::vector<Outcome> outcomes;
  for (const double factor : settings.factors) {
    Problem smaller = problem;
    smaller.budget = problem.budget / factor;
    outcomes.push_back(search(smaller, entries));
    out.explored += outcomes.back().statistics.entries;
    Candidate& candidate = out.candidates.emplace_back();
    candidate.made_for = factor;
    candidate.plan = outcomes.back().plan;
    for (const double other : settings.factors)
      candidate.scores.push_back(scored(problem, table, candidate.plan, other));
    candidate.judged = judged(candidate.scores, settings.judgement);
    if (candidate.judged > out.candidates[out.chosen].judged) out.chosen = out.candidates.size() - 1;
  }
  const Candidate& chosen = out.candidates[out.chosen];
  out.outcome = std::move(outcomes[out.chosen]);
  out.reason = "the plan made for " + decimal(chosen.made_for) +
               " times the predicted energy was chosen by its " +
               (settings.judgement == Judgement::worst ? "worst" : "mean") + " score under";
  for (std::size_t index = 0; index < settings.factors.size(); ++index)
    out.reason += (index == 0 ? " " : ", ") + decimal(settings.factors[index]);
  out.reason += " times that energy: " + to_text(chosen.judged);
  return out;
}

}  // namespace roci::planner::utility_htn::search
