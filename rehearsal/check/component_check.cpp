#include "rehearsal/check/component_check.hpp"

#include <algorithm>
#include <cctype>
#include <set>

#include "core/words/nearest_word.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using mission::Entry;

namespace {

// The highest n of ?n in a text; 0: there is none.
std::size_t highest_position(const std::string& text) {
  std::size_t highest = 0;
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '?' && std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0)
      highest = std::max(highest, static_cast<std::size_t>(text[i + 1] - '0'));
  return highest;
}

void check_facts(const Entry& state, const sim::world::StateForm& form) {
  const auto facts = state.find("facts");
  if (!facts) return;
  facts->each([&](const Entry& fact) {
    const std::size_t highest = highest_position(fact.text());
    if (highest <= form.arguments) return;
    fact.fail("the state '" + form.name + "' has " + std::to_string(form.arguments) + " arguments, and ?" +
              std::to_string(highest) + " stands here; name one that there is");
  });
}

// The states that stand in the file against those that there are. `all_are_needed`: one that is missing is a
// finding, and where none is, another one is no slip of the pen: a scenario may begin in it.
void check_states(const Entry& states, const std::string& whose,
                  const std::vector<sim::world::StateForm>& forms, bool all_are_needed) {
  if (forms.empty()) return;
  const auto known = names_of(forms);
  std::vector<std::string> left;  // that stand nowhere
  for (const std::string& name : known)
    if (!states.find(name)) left.push_back(name);
  std::set<std::string> meant;
  states.each_field([&](const std::string& name, const Entry& state) {
    const auto form = std::ranges::find(forms, name, &sim::world::StateForm::name);
    if (form != forms.end()) return check_facts(state, *form);
    if (all_are_needed && left.empty()) return;
    meant.insert(words::nearest_word(name, left));
    state.fail(whose + " is never in a state '" + name + "'; " + instead_of(name, known));
  });
  if (!all_are_needed) return;
  for (const std::string& name : left) {
    if (meant.contains(name)) continue;
    states.complain(whose + " can be in a state '" + name +
                    "', which does not stand here; add it, with active: true if something runs in it");
  }
}

class ComponentCheck {
 public:
  ComponentCheck(const CheckedMission& mission, const CheckedExecutive& executive)
      : mission_(mission), executive_(executive), timelines_(mission, executive) {}

  void component(const Entry& entry) const {
    const std::string name = entry.at("name").text();
    const auto& own = executive_.model.components;
    const auto model = std::ranges::find(own, name, &exec::mission::Component::name);
    if (model == own.end()) return;  // another robot's, or not read
    require_owner(entry.at("owner"), mission_.services);
    const bool simulated = !mission_.world.empty() && model->owner == mission_.world.service;
    const SimulatedComponent* there = mission_.world.find(model->robot, name);
    if (simulated && there == nullptr)
      return entry.at("name").complain("the simulated robot has no component '" + name + "'; " +
                                       instead_of(name, mission_.world.component_names(model->robot)));
    timelines_.require(entry.at("timeline"), model->timeline);
    if (const auto lost = entry.find("lost"))
      if (const auto services = lost->find("without"))
        services->each([&](const Entry& one) { require_owner(one, mission_.services); });
    if (!simulated || !there->known) return;
    if (const auto fallback = entry.find("fallback");
        fallback && !contains(names_of(there->commands), model->fallback))
      fallback->complain("'" + name + "' has no command '" + model->fallback + "'; " +
                         instead_of(model->fallback, names_of(there->commands)));
    if (const auto states = entry.find("states"))
      check_states(*states, "component '" + name + "'", there->states, true);
  }

  void family(const Entry& entry) const {
    const Entry timeline = entry.at("timeline");
    timelines_.require(timeline, timeline.text());
    const std::string name =
        exec::mission::fill_names(timeline.text(), {{"robot", executive_.model.role.robot}});
    const SimulatedFamily* there = mission_.world.family_of(name);
    const auto states = entry.find("states");
    if (there != nullptr && states) check_states(*states, "a thing of '" + name + "'", there->states, false);
  }

  void timeline_in(const Entry& entry) const {
    if (!entry.is_mapping()) return;
    if (const auto timeline = entry.find("timeline")) timelines_.require(*timeline, timeline->text());
  }

  void object(const Entry& entry) const {
    if (const auto properties = entry.find("properties"))
      properties->each_field([&](const std::string&, const Entry& value) { timeline_in(value); });
  }

 private:
  const CheckedMission& mission_;
  const CheckedExecutive& executive_;
  KnownTimelines timelines_;
};

// A window that a component waits for.
void check_awaited(const CheckedMission& mission, const std::string& robot,
                   const sim::setup::ComponentEntry& component) {
  const SimulatedComponent* there = mission.world.find(robot, component.name);
  if (there == nullptr) return;
  const auto windows = mission.windows();
  for (const std::string& window : there->windows) {
    if (contains(windows, window)) continue;
    component.entry.find("window")
        .value_or(component.entry)
        .complain("'" + component.name + "' waits for a window '" + window +
                  "' that the mission does not have; " + instead_of(window, windows));
  }
}

// The service that is asked for ways or motions; of what is said by none the name that the component takes for granted.
void check_planner(const CheckedMission& mission, const sim::setup::ComponentEntry& component) {
  const bool drives = component.type == "drive";
  if (!drives && component.type != "arm") return;
  const auto said = component.entry.find("planner");
  const std::string usual = drives ? "pathplan_svc" : "arm_svc";
  const std::string name = said ? said->text() : usual;
  if (mission.services.find(name) != nullptr) return;
  if (!said && mission.services.of_program(usual).empty()) return;  // its functions are missed elsewhere
  said.value_or(component.entry)
      .complain("'" + component.name + "' asks '" + name + "' for " + (drives ? "its ways" : "its motions") +
                ", and no such service stands in services:; name one under 'planner': " +
                instead_of(name, mission.services.names()));
}

// The states of other components that a command needs.
void check_needs(const CheckedMission& mission, const std::string& robot, const Entry& component) {
  const auto commands = component.find("commands");
  if (!commands) return;
  commands->each_field([&](const std::string&, const Entry& command) {
    const auto needs = command.find("needs");
    if (!needs) return;
    needs->each_field([&](const std::string& name, const Entry& state) {
      const SimulatedComponent* other = mission.world.find(robot, name);
      if (other == nullptr)
        state.fail("the robot has no component '" + name + "'; " +
                   instead_of(name, mission.world.component_names(robot)));
      require_state(state, mission.world, other->timeline(), state.text());
    });
  });
}

}  // namespace

void require_owner(const Entry& entry, const mission::ServiceList& services) {
  if (services.find(entry.text()) != nullptr) return;
  entry.complain("no service '" + entry.text() + "' stands in services:; " +
                 instead_of(entry.text(), services.names()));
}

void check_components(const CheckedMission& mission, const CheckedExecutive& executive) {
  const ComponentCheck check(mission, executive);
  const Entry& file = executive.file;
  if (const auto list = file.find("components")) list->each([&](const Entry& one) { check.component(one); });
  if (const auto list = file.find("families")) list->each([&](const Entry& one) { check.family(one); });
  if (const auto list = file.find("fluents")) list->each([&](const Entry& one) { check.timeline_in(one); });
  if (const auto list = file.find("objects")) list->each([&](const Entry& one) { check.object(one); });
}

void check_simulation(const CheckedMission& mission) {
  if (mission.scenarios.empty()) return;
  for (const sim::setup::RobotEntry& robot : mission.scenarios.front().run.roster) {
    for (const sim::setup::ComponentEntry& component : robot.components) {
      component.entry.attempt([&] { check_awaited(mission, robot.name, component); });
      component.entry.attempt([&] { check_planner(mission, component); });
      component.entry.attempt([&] { check_needs(mission, robot.name, component.entry); });
    }
  }
}

}  // namespace roci::rehearsal::check
