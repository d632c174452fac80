// What is asked for: requests come and go, wait for a place, or are closed.
#include <set>
#include <utility>
#include <vector>

#include "planner_svc/utility_htn/cycle/cycle.hpp"
#include "planner_svc/utility_htn/flattening/reach.hpp"

namespace roci::planner::utility_htn::cycle {

using model::TaskIndex;
using temporal::Time;

// A contingency edits the network (R69).
void Cycle::edit_network(TaskIndex task) {
  const auto& contingency = network_.tasks[task].contingency;
  if (!contingency) return;
  for (const TaskIndex one : contingency->requests) {
    request(one);
    if (network_.tasks[one].is_template) past_.contingent.insert(one);
  }
  for (const TaskIndex one : contingency->withdraws) withdraw(one);
}

void Cycle::request(TaskIndex task) {
  const bool again = past_.done.erase(task) != 0;
  past_.failures.erase(task);
  past_.withdrawn.erase(task);
  to_schedule_ |= requested_.insert(task).second || again;
}

void Cycle::still_requested(TaskIndex task) {
  if (failed_too_often(task) || past_.done.contains(task) || past_.withdrawn.contains(task)) return;
  to_schedule_ |= requested_.insert(task).second;
}

bool Cycle::failed_too_often(TaskIndex task) const {
  const auto known = past_.failures.find(task);
  return known != past_.failures.end() && known->second >= settings_.most_failures;
}

// Templates are nobody's request until somebody asks.
void Cycle::give_up(TaskIndex task) {
  requested_.erase(task);
  past_.contingent.erase(task);
  if (!network_.tasks[task].is_template) past_.withdrawn.insert(task);
}

void Cycle::withdraw(TaskIndex task) {
  if (!requested_.contains(task)) return;
  give_up(task);
  for (std::size_t i = blocks_.size(); i-- > 0;) {
    if (chains_.chains[blocks_[i].chain].task != task || blocks_[i].begun()) continue;
    take_out(blocks_[i]);
    blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  to_optimize_ = true;
}

std::vector<TaskIndex> Cycle::waiting() const {
  std::set<TaskIndex> placed;
  for (const Block& one : blocks_) placed.insert(chains_.chains[one.chain].task);
  std::vector<TaskIndex> out;
  for (const TaskIndex task : requested_)
    if (!placed.contains(task) && !past_.done.contains(task)) out.push_back(task);
  return out;
}

std::vector<TaskIndex> Cycle::closed(Time now) const {
  const std::vector<TaskIndex> open = waiting();
  return closed_but({open.begin(), open.end()}, now);
}

// What is placed is open, too.
std::vector<TaskIndex> Cycle::closed_but(std::set<TaskIndex> open, Time now) const {
  const std::vector<double> newest = values_now(now);
  flattening::Prospects prospects{newest, open};
  std::set<TaskIndex> placed;
  for (const Block& one : blocks_) {
    placed.insert(chains_.chains[one.chain].task);
    for (const Link& each : one.links)
      if (is_placed(each)) prospects.under_way.push_back(each.task);
  }
  for (const TaskIndex task : flattening::out_of_reach(network_, chains_, past_.values, prospects))
    open.erase(task);
  std::vector<TaskIndex> out;
  for (const flattening::Chain& chain : chains_.chains)
    if (!open.contains(chain.task) && !placed.contains(chain.task) &&
        (out.empty() || out.back() != chain.task))
      out.push_back(chain.task);
  return out;
}

// Returns the requests that wait and whose preferred start lies within the scheduling window (R79).
std::set<TaskIndex> Cycle::candidates(Time now) const {
  const Time until = temporal::plus(now, network_.cycle.scheduling_window);
  std::set<TaskIndex> out;
  for (const TaskIndex task : waiting()) {
    const Time preferred = network_.tasks[task].preferred_start;
    if (!temporal::bounded(preferred) || preferred < until) out.insert(task);
  }
  return out;
}

// A request whose preferred start the scheduling window reaches as time passes is tried then.
void Cycle::slide_window(Time now) {
  const Time before = std::exchange(window_end_, temporal::plus(now, network_.cycle.scheduling_window));
  if (!temporal::bounded(window_end_)) return;
  for (const TaskIndex task : waiting()) {
    const Time preferred = network_.tasks[task].preferred_start;
    to_schedule_ |= temporal::bounded(preferred) && preferred >= before && preferred < window_end_;
  }
}

}  // namespace roci::planner::utility_htn::cycle
