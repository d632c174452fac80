#include "planner_svc/temporal_pddl/improvement/fresh_starts.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/temporal_pddl/search/search.hpp"
#include "planner_svc/temporal_pddl/search/serial_search.hpp"

namespace roci::planner::temporal_pddl {

namespace {

constexpr int kPatience = 4;

}  // namespace

FreshStarts::FreshStarts(const Task& task, Heuristic& pruning, FfHeuristic& ff, const Options& options,
                         Watch& watch, Statistics& statistics)
    : task_(task), pruning_(pruning), ff_(ff), options_(options), watch_(watch), statistics_(statistics) {}

bool FreshStarts::promising() const {
  return in_vain_ < kPatience && task_.goals.size() == 1 && task_.goals.front().facts.size() > 1;
}

FreshStarts::Outcome FreshStarts::next(std::size_t evaluations) {
  ++options_.seed;
  const std::size_t before = statistics_.evaluated;
  SerialSearch search(task_, pruning_, ff_, options_, simplest_steps(task_, options_), watch_, statistics_);
  auto found = search.run(evaluations, 0);
  Outcome outcome{std::nullopt, std::max<std::size_t>(1, statistics_.evaluated - before)};
  if (found) in_vain_ = found->plan ? 0 : in_vain_ + 1;
  if (found && found->plan) outcome.plan = std::move(found->plan);
  return outcome;
}

}  // namespace roci::planner::temporal_pddl
