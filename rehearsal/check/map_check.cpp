#include "rehearsal/check/map_check.hpp"

#include <charconv>
#include <cstdio>
#include <map>
#include <optional>
#include <variant>

#include "core/terrain/site.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "rehearsal/check/scenario_check.hpp"

namespace roci::rehearsal::check {

using exec::mission::ObjectModel;
using mission::Entry;
using sim::scenario::GoalStimulus;
using terrain::Grid, terrain::Point;
using Values = std::map<std::string, std::string>;

namespace {

const Grid* grid_of(const CheckedScenario& scenario) {
  const auto& site = scenario.run.world.ground.site;
  return site ? &site->grid() : nullptr;
}

// Of a mission all scenarios have the same map.
const Grid* grid_of(const CheckedMission& mission) {
  for (const CheckedScenario& scenario : mission.scenarios)
    if (const Grid* grid = grid_of(scenario)) return grid;
  return nullptr;
}

std::string number_text(double number) {
  char out[32];
  std::snprintf(out, sizeof(out), "%.6g", number);
  return out;
}

std::string point_text(Point p) { return "(" + number_text(p.x) + ", " + number_text(p.y) + ")"; }

std::string remedy(const Grid& grid) {
  return "; the map reaches from " + point_text(grid.origin) + " to " +
         point_text({grid.origin.x + grid.width(), grid.origin.y + grid.height()}) + ", in metres";
}

std::optional<double> number_of(const ObjectModel& object, std::string_view property, const Values& values) {
  for (const auto& source : object.properties) {
    if (source.name != property || source.timeline) continue;
    const std::string text = exec::mission::fill_names(source.text, values);
    double out = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
    if (error == std::errc() && end == text.data() + text.size()) return out;
  }
  return std::nullopt;
}

std::optional<Point> place_of(const ObjectModel& object, const Values& values) {
  const auto x = number_of(object, "x", values), y = number_of(object, "y", values);
  return x && y ? std::optional(Point{*x, *y}) : std::nullopt;
}

bool expects_a_loss(const CheckedScenario& scenario) {
  for (const auto& event : scenario.run.scenario.expect)
    for (const char* given_up : {"goal.dropped", "goal.failed", "goal.rejected"})
      if (event.code == given_up) return true;
  return false;
}

void check_goal(const CheckedMission& mission, const GoalStimulus& goal, const Grid& grid) {
  for (const CheckedExecutive& executive : mission.executives) {
    const auto kind = executive.model.goal_kinds.find(goal.kind);
    if (kind == executive.model.goal_kinds.end()) continue;
    Values values{{"id", goal.id}, {"robot", goal.robot}};
    for (const auto& [name, value] : goal.arguments) values[name] = value;
    for (const ObjectModel& object : kind->second.objects) {
      const auto place = place_of(object, values);
      if (!place || grid.contains(*place)) continue;
      return goal.entry->complain("goal '" + goal.id + "' asks for " +
                                  exec::mission::fill_names(object.name, values) + " at " +
                                  point_text(*place) + ", which lies outside the map" + remedy(grid));
    }
  }
}

// A rock or an obstacle: {x: …, y: …, radius: …}.
void warn_of_rock(const Entry& rock, const std::string& what, const Grid& grid, mission::Findings& findings) {
  const Point at{rock.at("x").number(), rock.at("y").number()};
  if (grid.contains(at)) return;
  findings.add(mission::finding_of(rock.place() + ": " + what + " at " + point_text(at) +
                                       " lies outside the map, where nobody meets it" + remedy(grid),
                                   mission::Severity::warning));
}

}  // namespace

void check_objects_on_map(const CheckedMission& mission, const CheckedExecutive& executive) {
  const Grid* grid = grid_of(mission);
  const auto objects = executive.file.find("objects");
  if (grid == nullptr || !objects || !objects->is_sequence()) return;
  objects->each([&](const Entry& entry) {
    for (const ObjectModel& object : executive.model.objects) {
      if (object.name != entry.at("name").text()) continue;
      const auto place = place_of(object, {});
      if (place && !grid->contains(*place))
        entry.complain("object '" + object.name + "' at " + point_text(*place) + " lies outside the map" +
                       remedy(*grid));
    }
  });
}

void check_scenario_on_map(const CheckedMission& mission, const CheckedScenario& scenario,
                           mission::Findings& findings) {
  const Grid* grid = grid_of(scenario);
  if (grid == nullptr) return;
  if (!expects_a_loss(scenario))
    for (const auto& stimulus : scenario.run.scenario.stimuli)
      if (const auto* goal = std::get_if<GoalStimulus>(&stimulus.what)) check_goal(mission, *goal, *grid);
  const auto world = scenario.file.find("world");
  const auto rocks = world && world->is_mapping() ? world->find("rocks") : std::nullopt;
  if (rocks) rocks->each([&](const Entry& rock) { warn_of_rock(rock, "the rock", *grid, findings); });
  const auto stimuli = scenario.file.find("stimuli");
  if (!stimuli || !stimuli->is_sequence()) return;
  stimuli->each([&](const Entry& stimulus) {
    if (const auto hazard = stimulus.find("hazard")) warn_of_rock(*hazard, "the obstacle", *grid, findings);
  });
}

}  // namespace roci::rehearsal::check
