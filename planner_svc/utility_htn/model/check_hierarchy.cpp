#include <numeric>
#include <set>

#include "planner_svc/utility_htn/model/bounds.hpp"
#include "planner_svc/utility_htn/model/complaints.hpp"
#include "planner_svc/utility_htn/model/hierarchy.hpp"

namespace roci::planner::utility_htn::model {

namespace {

void check_cycle_of_parents(const std::vector<TaskIndex>& cycle, Complaints& complaints) {
  std::string words;
  for (const TaskIndex index : cycle) words += "'" + complaints.network.tasks[index].id + "' holds ";
  complaints.about(Part::task, cycle.front());
  complaints.error(
      "it is a part of itself: " + words + "'" + complaints.network.tasks[cycle.front()].id + "'",
      "take one of them out of the other's decompositions");
}

// Who uses each task: as a subtask, on failure, or by asking for it.
void check_use(Complaints& complaints) {
  const Network& network = complaints.network;
  std::set<TaskIndex> subtasks, used;
  for (const Task& task : network.tasks) {
    for (const Decomposition& decomposition : task.decompositions)
      for (const Subtask& subtask : decomposition.subtasks) subtasks.insert(subtask.task);
    if (task.contingency) used.insert(task.contingency->requests.begin(), task.contingency->requests.end());
  }
  used.insert(subtasks.begin(), subtasks.end());
  for (TaskIndex index = 0; index < network.tasks.size(); ++index) {
    const Task& task = network.tasks[index];
    complaints.about(Part::task, index);
    if (task.is_template && !used.contains(index))
      complaints.warning("the template is never used",
                         "request it, put it into a decomposition or a contingency, or take it out");
    if (!task.is_template && subtasks.contains(index))
      complaints.warning("it is requested by itself, and a subtask of others besides",
                         "make it a template unless it is to be done for its own sake, too");
  }
}

}  // namespace

void check_hierarchy(Complaints& complaints) {
  const Network& network = complaints.network;
  const Hierarchy hierarchy = measure(network);
  if (!hierarchy.cycle.empty()) return check_cycle_of_parents(hierarchy.cycle, complaints);
  std::size_t links = 0;
  for (TaskIndex index = 0; index < network.tasks.size(); ++index) {
    const Extent& extent = hierarchy.extents[index];
    complaints.about(Part::task, index);
    if (extent.depth > kDeepestHierarchy)
      complaints.error("it stands on " + std::to_string(extent.depth) + " levels of subtasks, at most " +
                           std::to_string(kDeepestHierarchy) + " are permitted",
                       "flatten it");
    if (network.tasks[index].is_template) continue;
    if (extent.chains > kMostChains)
      complaints.error("it can be done in more than " + std::to_string(kMostChains) +
                           " ways, since the choices of its subtasks multiply",
                       "make tasks of their own of some of them");
    else if (__builtin_add_overflow(links, extent.links, &links))
      links = std::numeric_limits<std::size_t>::max();
  }
  complaints.about(Part::network, 0);
  complaints.more_than("links in all chains together", links, kMostLinks);
  check_use(complaints);
}

}  // namespace roci::planner::utility_htn::model
