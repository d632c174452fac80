#include "exec_svc/problem/timeline_problem.hpp"

#include <algorithm>
#include <set>

namespace roci::exec::problem {

using goals::GoalRecord;
using mission::ObjectModel;
using mission::WindowModel;

namespace {

using temporal::Value;

std::map<std::string, Value> state_at_origin(const Situation& situation) {
  std::map<std::string, Value> out = situation.beliefs.values();
  out.insert(situation.beliefs.concluded().begin(), situation.beliefs.concluded().end());
  for (const auto& [timeline, value] : situation.forecast.values) out.insert_or_assign(timeline, value);
  for (const auto& [timeline, change] : situation.forecast.changes) {
    const auto known = out.find(timeline);
    if (known == out.end()) continue;
    if (double* number = std::get_if<double>(&known->second)) *number += change;
  }
  return out;
}

// Returns whether a window that is open now closes before the origin, beyond which its present observation
// does not count.
bool closes_until_origin(const WindowModel& window, const Situation& situation) {
  return std::ranges::any_of(window.open, [&](const auto& interval) {
    return interval.first <= situation.now && situation.now < interval.second &&
           interval.second <= situation.origin;
  });
}

void add_window(const WindowModel& window, const Situation& situation, Problem& out) {
  if (closes_until_origin(window, situation)) out.state.insert_or_assign(window.timeline, false);
  for (const OpenInterval& interval : intervals_ahead(window, situation)) {
    if (interval.from <= situation.origin) {
      out.state.insert_or_assign(window.timeline, true);
    } else {
      out.predictions.push_back({window.timeline, interval.from, true});
    }
    out.predictions.push_back({window.timeline, interval.to, false});
  }
}

std::set<std::string> named_objects(const std::map<std::string, Value>& state) {
  std::set<std::string> out;
  for (const auto& [timeline, value] : state)
    if (const auto* held = std::get_if<temporal::State>(&value))
      out.insert(held->arguments.begin(), held->arguments.end());
  return out;
}

}  // namespace

Problem write_timeline_problem(const Situation& situation) {
  Problem out;
  out.state = state_at_origin(situation);
  for (const WindowModel& window : situation.mission.windows) add_window(window, situation, out);
  std::ranges::stable_sort(out.predictions, {}, &PredictedValue::at);
  const std::set<std::string> named = named_objects(out.state);
  std::map<std::string, ObjectModel> objects;
  for (const ObjectModel& object : situation.mission.objects)
    if (!object.dynamic || named.contains(object.name)) objects.insert_or_assign(object.name, object);
  for (const GoalRecord* record : situation.goals.present())
    for (ObjectModel& object : objects_of(situation.mission, record->request))
      if (!goals::is_final(record->state) || named.contains(object.name))
        objects.insert_or_assign(object.name, object);
  for (const auto& [name, object] : objects)
    out.objects.push_back({name, object.type, properties_of(object, situation.beliefs)});
  return out;
}

}  // namespace roci::exec::problem
