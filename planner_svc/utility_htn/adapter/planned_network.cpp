#include "planner_svc/utility_htn/adapter/planned_network.hpp"

#include <algorithm>
#include <utility>

#include "planner_svc/utility_htn/adapter/index_of.hpp"
#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"

namespace roci::planner::utility_htn::adapter {

using temporal::Time;

PlannedNetwork::PlannedNetwork(model::Network network, const cycle::Settings& settings,
                               const Resolvers& chosen)
    : network_(std::move(network)),
      chains_(flattening::flatten_all(network_)),
      assessor_(std::make_unique<assessor::SubwayAssessor>(network_, chains_)),
      scheduler_(search::make_scheduler(chosen.scheduler)),
      settings_(settings),
      delivery_(network_) {
  if (chosen.search != cycle::Search::once) settings_.search = chosen.search;
}

PlannedNetwork::~PlannedNetwork() = default;

void PlannedNetwork::begin(Time origin) {
  cycle_ = std::make_unique<cycle::Cycle>(network_, chains_, *assessor_, *scheduler_, origin, settings_);
  if (settings_.downlinks) cycle_->deliver_by(delivery_);
}

Situation PlannedNetwork::situation(Time now) const {
  return {network_, chains_, *assessor_, *cycle_, delivery_, now};
}

std::optional<model::TaskIndex> PlannedNetwork::task_named(const std::string& id) const {
  return index_of(network_.tasks, id, &model::Task::id);
}

// What tasks have made of an internal timeline since the ground has set it stands in the plan that is executed.
bool PlannedNetwork::tasks_move(const std::string& timeline) const {
  const auto index = index_of(network_.timelines, timeline, &temporal::timelines::Definition::name);
  if (!index || network_.timelines[*index].reported) return false;
  return std::ranges::any_of(network_.tasks, [&](const model::Task& task) {
    return std::ranges::any_of(task.impacts, [&](const auto& impact) { return impact.timeline == *index; });
  });
}

// The first cycle cannot commit what would have to start at once. What began before it and has no command, as a view of
// Earth, holds for the rest of its time; a command that is late is missed.
void PlannedNetwork::place_fixed_tasks(Time origin) {
  if (std::exchange(fixed_tasks_stand_, true)) return;
  const Time first = origin + network_.cycle.commit_window;
  for (model::Task& task : network_.tasks) {
    if (!task.fixed || task.preferred_start >= first) continue;
    if (task.commands.empty()) {
      const double late = temporal::to_seconds(first - task.preferred_start);
      if (late >= model::duration_s(task, cycle_->past().values)) continue;
      task.duration.constant -= late;
    } else if (task.preferred_start < origin) {
      continue;
    }
    task.preferred_start = first;
  }
}

std::string PlannedNetwork::learn(const std::string& parameter, double value) {
  const auto known = index_of(network_.parameters, parameter, &model::Parameter::name);
  if (!known) return "the network has no parameter '" + parameter + "'";
  if (cycle_ == nullptr) return "nothing is planned yet";
  return cycle_->set_value(*known, value);
}

}  // namespace roci::planner::utility_htn::adapter
