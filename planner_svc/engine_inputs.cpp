#include "planner_svc/engine_inputs.hpp"

#include <string_view>
#include <unordered_set>

#include "planner_svc/limits.hpp"

namespace roci::planner {

using engine::GoalState;

namespace {

bool is_open(GoalState state) { return state == GoalState::pending || state == GoalState::planned; }

std::size_t size_of(const std::string& name) { return name.size(); }
std::size_t size_of(const std::pair<std::string, std::string>& name) {
  return name.first.size() + name.second.size();
}
std::size_t size_of(const std::tuple<std::string, std::string, std::uint32_t>& name) {
  return std::get<0>(name).size() + std::get<1>(name).size();
}

}  // namespace

// The executive refuses likewise, so that both know the same.
template <class Table>
bool EngineInputs::has_room(const Table& table, const typename Table::key_type& name, std::size_t room,
                            const char* what) const {
  if (table.contains(name) || (table.size() < room && size_of(name) <= kNameBytes)) return true;
  refused_(what, room);
  return false;
}

bool EngineInputs::hear(engine::Goal goal) {
  const Key key{goal.issuer, goal.id};
  if (!has_room(goals_, key, kGoals, "goal")) return false;
  HeardGoal& heard = goals_[key];
  const bool changed = heard.goal != goal;
  heard.goal = std::move(goal);
  return note_goal(key, heard, changed);
}

bool EngineInputs::hear_status(const std::string& issuer, const std::string& id, GoalState state) {
  const Key key{issuer, id};
  if (!has_room(goals_, key, kGoals, "goal")) return false;
  HeardGoal& heard = goals_[key];
  heard.state = state;
  return note_goal(key, heard, false);
}

bool EngineInputs::note_goal(const Key& key, HeardGoal& heard, bool changed) {
  const bool open = heard.goal && heard.state && is_open(*heard.state);
  if (open && (changed || !heard.told)) {
    heard.told = true;
    heard_.goals.push_back(*heard.goal);
    return true;
  }
  if (!open && heard.told) {
    heard.told = false;
    heard_.ended_goals.push_back({key.first, key.second, *heard.state});
    return true;
  }
  return false;
}

bool EngineInputs::hear(engine::Observation observation) {
  if (!has_room(state_, observation.timeline, kTimelines, "timeline")) return false;
  state_.insert_or_assign(observation.timeline, observation.value);
  heard_.observations.push_back(std::move(observation));
  return true;
}

bool EngineInputs::hear(engine::StepStatus step) {
  if (!has_room(progress_, step.activity, kActivities, "step")) return false;
  progress_.insert_or_assign(step.activity, step.progress);
  heard_.steps.push_back(std::move(step));
  return true;
}

bool EngineInputs::hear(engine::DataProduct product) {
  if (!has_room(products_, product.id, kProducts, "data product")) return false;
  engine::DataProduct& known = products_[product.id];
  engine::DataProduct again = known;
  again.told = product.told;
  if (again == product) return false;
  known = std::move(product);
  heard_.products.push_back(known);
  return true;
}

bool EngineInputs::hear(const std::string& commander, engine::CommandResult result) {
  if (!executive_.empty() && commander != executive_) return false;
  const ResultKey key{commander, result.activity, result.attempt};
  if (!has_room(results_, key, kResults, "result")) return false;
  const auto known = results_.find(key);
  if (known != results_.end() && known->second == result) return false;
  results_.insert_or_assign(key, result);
  if (executive_.empty()) return false;
  heard_.results.push_back(std::move(result));
  return true;
}

// Before this is known results are kept of whoever commands.
void EngineInputs::note_executive(const std::string& executive) {
  if (!executive_.empty()) return;
  executive_ = executive;
  std::erase_if(results_, [&](const auto& one) { return std::get<0>(one.first) != executive_; });
  for (const auto& [key, result] : results_) heard_.results.push_back(result);
}

void EngineInputs::note_executed(const temporal::FlexiblePlan& plan) {
  std::unordered_set<std::string_view> ids;
  for (const temporal::PlanActivity& activity : plan.activities) ids.insert(activity.id);
  std::erase_if(progress_, [&](const auto& step) { return !ids.contains(step.first); });
  std::erase_if(results_, [&](const auto& one) { return !ids.contains(std::get<1>(one.first)); });
}

bool EngineInputs::waiting() const {
  return !heard_.goals.empty() || !heard_.ended_goals.empty() || !heard_.observations.empty() ||
         !heard_.steps.empty() || !heard_.products.empty() || !heard_.results.empty();
}

void EngineInputs::tell_again(engine::StepInputs& inputs) const {
  const std::uint32_t version = inputs.executed->version;
  std::vector<engine::StepStatus> steps;
  for (const auto& [activity, progress] : progress_) steps.push_back({version, activity, progress, "", 0});
  inputs.steps.insert(inputs.steps.begin(), steps.begin(), steps.end());
  inputs.results.clear();
  for (const auto& [key, result] : results_)
    if (std::get<0>(key) == executive_) inputs.results.push_back(result);
}

void EngineInputs::engine_is_new(temporal::Time now) {
  heard_ = {};
  heard_.goals = open_goals();
  for (const auto& [timeline, value] : state_) heard_.observations.push_back({timeline, value, now});
  for (const auto& [id, product] : products_) heard_.products.push_back(product);
}

std::vector<engine::Goal> EngineInputs::open_goals() const {
  std::vector<engine::Goal> out;
  for (const auto& [key, heard] : goals_)
    if (heard.told) out.push_back(*heard.goal);
  return out;
}

}  // namespace roci::planner
