#include "exec_svc/problem/situation.hpp"

#include <array>
#include <charconv>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::problem {

using goals::GoalRequest;
using mission::fill_names;
using mission::MissionModel;
using mission::ObjectModel;
using mission::PropertySource;
using mission::WindowModel;

std::vector<OpenInterval> intervals_ahead(const WindowModel& window, const Situation& situation) {
  const temporal::Value* observed = situation.beliefs.value(window.timeline);
  const bool seen_closed = observed != nullptr && *observed == temporal::Value(false);
  std::vector<OpenInterval> out;
  for (const auto& [from, to] : window.open) {
    const bool should_be_open_and_is_not = from < situation.now && seen_closed;
    if (!should_be_open_and_is_not && to > situation.origin) out.push_back({from, to});
  }
  return out;
}

std::vector<ObjectModel> objects_of(const MissionModel& mission, const GoalRequest& goal) {
  const auto values = template_values(goal);
  std::vector<ObjectModel> out = mission.goal_kinds.at(goal.kind).objects;
  for (ObjectModel& object : out) {
    object.name = fill_names(object.name, values);
    for (PropertySource& property : object.properties) {
      property.text = fill_names(property.text, values);
      if (property.timeline) property.timeline = fill_names(*property.timeline, values);
    }
  }
  return out;
}

std::vector<temporal::Property> properties_of(const ObjectModel& object, const beliefs::Beliefs& beliefs) {
  std::vector<temporal::Property> out;
  for (const PropertySource& property : object.properties) {
    if (!property.timeline) {
      out.push_back({property.name, property.text});
    } else if (const temporal::Value* observed = beliefs.value(*property.timeline)) {
      const double* number = std::get_if<double>(observed);
      if (number != nullptr) out.push_back({property.name, number_text(*number)});
    }
  }
  return out;
}

std::string number_text(double value) {
  std::array<char, 400> buffer{};  // the longest finite double has 309 digits before the point
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, 6);
  return std::string(buffer.data(), result.ptr);
}

}  // namespace roci::exec::problem
