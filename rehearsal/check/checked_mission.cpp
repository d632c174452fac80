#include "rehearsal/check/checked_mission.hpp"

#include <algorithm>

#include "core/words/nearest_word.hpp"
#include "exec_svc/mission/template_text.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using mission::Entry;

namespace {

// "rover.sample.sample-{id}" → "rover.sample.": what stands before the slot, as far as its last dot.
std::string family_part(const std::string& text) {
  const std::string before = text.substr(0, text.find('{'));
  const std::size_t dot = before.rfind('.');
  return dot == std::string::npos ? "" : before.substr(0, dot + 1);
}

}  // namespace

std::vector<std::string> CheckedMission::windows() const {
  std::vector<std::string> out;
  const auto list = file.find("windows");
  if (!list || !list->is_sequence()) return out;
  for (const Entry& item : list->items())
    if (item.is_mapping())
      if (const auto timeline = item.find("timeline")) out.push_back(timeline->text());
  return out;
}

KnownTimelines::KnownTimelines(const CheckedMission& mission, const CheckedExecutive& executive)
    : mission_(mission),
      robot_(executive.model.role.robot),
      closed_(mission.closed && (executive.model.has_domain() || executive.planned_timelines)),
      names_(mission.world.timelines) {
  for (const SimulatedFamily& family : mission.world.families) prefixes_.push_back(family.prefix);
  for (const SimulatedComponent& component : mission.world.components)
    if (!component.known) prefixes_.push_back(component.timeline() + ".");  // numbers of its own, perhaps
  for (const exec::mission::Component& component : executive.model.components) {
    if (component.owner == mission.world.service) continue;
    names_.push_back(component.timeline);
    prefixes_.push_back(component.timeline + ".");
  }
  if (executive.planned_timelines)
    for (const std::string& name : *executive.planned_timelines)
      (name.ends_with('.') ? prefixes_ : names_).push_back(name);
  for (const std::string& window : mission.windows()) names_.push_back(window);
  for (const std::string& value : executive.model.ground.values) names_.push_back(value);
}

void KnownTimelines::require(const Entry& entry, const std::string& text) const {
  if (mission_.world.empty()) return;
  const std::string name = robot_.empty() ? text : exec::mission::fill_names(text, {{"robot", robot_}});
  const auto belongs = [&](const std::string& prefix) { return name.starts_with(prefix); };
  if (contains(names_, name) || std::ranges::any_of(prefixes_, belongs)) return;
  const bool is_template = name.find_first_of("{*") != std::string::npos;
  const std::string word = is_template ? family_part(name) : name;
  const std::vector<std::string>& known = is_template ? prefixes_ : names_;
  if (!closed_ && words::nearest_word(word, known).empty()) return;
  entry.complain("nobody tells of a timeline '" + name + "'; " + instead_of(word, known));
}

void require_state(const Entry& entry, const SimulatedWorld& world, const std::string& timeline,
                   const std::string& state) {
  const SimulatedComponent* component = world.on_timeline(timeline);
  const SimulatedFamily* family = world.family_of(timeline);
  if (state.find('{') != std::string::npos || (component == nullptr && family == nullptr)) return;
  const auto known = names_of(component != nullptr ? component->states : family->states);
  if (known.empty() || contains(known, state)) return;
  entry.complain("'" + timeline + "' is never in a state '" + state + "'; " + instead_of(state, known));
}

}  // namespace roci::rehearsal::check
