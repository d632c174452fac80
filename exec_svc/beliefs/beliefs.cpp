#include "exec_svc/beliefs/beliefs.hpp"

#include <algorithm>
#include <utility>

#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::beliefs {

using mission::Component;
using mission::fill_positions;
using mission::fill_star;
using mission::FluentSource;
using mission::MissionModel;
using mission::StateModel;
using mission::TimelineFamily;
using mission::WindowModel;
using mission::words_of;

namespace {

// Holds the model of the state that a value is in, and that state's arguments; null for a value that is no
// known state.
struct Seen {
  const StateModel* model = nullptr;
  std::vector<std::string> arguments;
};

Seen seen_state(const std::vector<StateModel>& states, const temporal::Value* value) {
  const auto* state = value == nullptr ? nullptr : std::get_if<temporal::State>(value);
  if (state == nullptr) return {};
  const auto found =
      std::find_if(states.begin(), states.end(), [&](const StateModel& s) { return s.name == state->name; });
  return found == states.end() ? Seen{} : Seen{&*found, state->arguments};
}

std::optional<temporal::Value> copied(const temporal::Value* value) {
  return value == nullptr ? std::nullopt : std::optional(*value);
}

}  // namespace

Beliefs::Beliefs(const MissionModel& mission) : mission_(&mission) {
  const auto note = [&](const std::vector<StateModel>& states) {
    for (const StateModel& state : states) {
      for (const std::string& fact : state.facts) {
        const auto words = words_of(fact);
        if (!words.empty()) observable_predicates_.insert(words.front());
      }
    }
  };
  for (const Component& component : mission.components) note(component.states);
  for (const TimelineFamily& family : mission.families) note(family.states);
}

void Beliefs::observe(const std::string& timeline, temporal::Value value) {
  concluded_.erase(timeline);
  values_.insert_or_assign(timeline, std::move(value));
}

void Beliefs::assume(const std::string& timeline, std::vector<std::string> facts) {
  assumed_.insert_or_assign(timeline, std::move(facts));
}

bool Beliefs::conclude(const std::string& timeline, const std::optional<temporal::Value>& value) {
  if (values_.contains(timeline)) return false;
  if (!value) return concluded_.erase(timeline) > 0;
  const auto [entry, added] = concluded_.try_emplace(timeline, *value);
  return added || std::exchange(entry->second, *value) != *value;
}

const temporal::Value* Beliefs::value(const std::string& timeline) const {
  const auto found = values_.find(timeline);
  return found == values_.end() ? nullptr : &found->second;
}

std::set<std::string> Beliefs::component_facts() const {
  std::set<std::string> out;
  for (const Component& component : mission_->components) {
    const Seen seen = seen_state(component.states, value(component.timeline));
    if (seen.model == nullptr) continue;
    for (const std::string& fact : seen.model->facts) out.insert(fill_positions(fact, seen.arguments));
  }
  return out;
}

std::set<std::string> Beliefs::family_facts() const {
  std::set<std::string> out;
  for (const TimelineFamily& family : mission_->families) {
    for (auto it = values_.lower_bound(family.prefix);
         it != values_.end() && it->first.starts_with(family.prefix); ++it) {
      const Seen seen = seen_state(family.states, &it->second);
      if (seen.model == nullptr) continue;
      const std::string object = it->first.substr(family.prefix.size());
      for (const std::string& fact : seen.model->facts)
        out.insert(fill_star(fill_positions(fact, seen.arguments), object));
    }
  }
  for (const auto& [timeline, facts] : assumed_) {
    if (!values_.contains(timeline)) out.insert(facts.begin(), facts.end());
  }
  return out;
}

std::optional<temporal::Value> Beliefs::lookup(const std::string& name) const {
  if (!name.starts_with('(')) return copied(value(name));
  for (const FluentSource& source : mission_->fluents) {
    if (source.fluent != name) continue;
    if (!source.timeline) return temporal::Value(source.value);
    return copied(value(*source.timeline));
  }
  for (const WindowModel& window : mission_->windows) {
    if (window.fact != name) continue;
    return copied(value(window.timeline));
  }
  const auto words = words_of(name);
  if (words.empty() || !observable_predicates_.contains(words.front())) return std::nullopt;
  return temporal::Value(component_facts().contains(name) || family_facts().contains(name));
}

bool Beliefs::holds(const std::vector<std::string>& facts) const {
  return std::all_of(facts.begin(), facts.end(), [&](const std::string& fact) {
    const auto value = lookup(fact);
    return value && *value == temporal::Value(true);
  });
}

std::vector<const Component*> Beliefs::active() const {
  std::vector<const Component*> out;
  for (const Component& component : mission_->components) {
    const temporal::Value* observed = value(component.timeline);
    const StateModel* state = seen_state(component.states, observed).model;
    if (observed != nullptr && (state == nullptr || state->active)) out.push_back(&component);
  }
  return out;
}

std::vector<const Component*> Beliefs::unobserved() const {
  std::vector<const Component*> out;
  for (const Component& component : mission_->components) {
    if (value(component.timeline) == nullptr) out.push_back(&component);
  }
  return out;
}

}  // namespace roci::exec::beliefs
