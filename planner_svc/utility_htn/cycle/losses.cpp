// What was planned and is not any more, with the reason (R119):
// whoever reads what a cycle did sees what the mission has lost.
#include <map>
#include <set>
#include <vector>

#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/search/explanation.hpp"

namespace roci::planner::utility_htn::cycle {

using model::TaskIndex;
using temporal::Time;

void Cycle::tell_losses(Time now, Report& report) {
  std::map<TaskIndex, std::uint32_t> lost;
  for (const TaskIndex task : waiting())
    if (const auto known = planned_.find(task); known != planned_.end()) lost.insert(*known);
  planned_.clear();
  for (const Block& one : blocks_)
    if (!one.begun()) planned_[chains_.chains[one.chain].task] = one.chain;
  if (lost.empty()) return;
  std::set<TaskIndex> asked;
  for (const auto& [task, chain] : lost) asked.insert(task);
  const std::vector<double> newest = values_now(now);
  const search::Problem problem = problem_for(now, asked, newest);
  for (const auto& [task, chain] : lost)
    report.notes.push_back(search::why_not(problem, searched_, chain).text);
}

}  // namespace roci::planner::utility_htn::cycle
