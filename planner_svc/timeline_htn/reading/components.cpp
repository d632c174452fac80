#include <algorithm>
#include <limits>

#include "core/words/nearest_word.hpp"
#include "planner_svc/timeline_htn/model/bounds.hpp"
#include "planner_svc/timeline_htn/reading/sections.hpp"

namespace roci::planner::timeline_htn::reading {

using mission::Entry;
using model::Index, model::Layer, model::NeedKind, model::State, model::StateKind, model::Term,
    model::Variable;

namespace {

template <typename Value>
Value one_of(const Entry& entry, const std::vector<std::pair<std::string, Value>>& known) {
  const std::string word = entry.text();
  std::vector<std::string> words;
  for (const auto& [name, value] : known) {
    if (name == word) return value;
    words.push_back(name);
  }
  std::string list;
  for (const std::string& one : words) list += (list.empty() ? "" : ", ") + one;
  entry.fail("expected one of " + list + ", not '" + word.substr(0, 60) + "'" +
             words::did_you_mean(word, words));
}

void declare_state(const std::string& name, const Entry& entry, Index component, Vocabulary& vocabulary) {
  vocabulary.states[component].add(name, entry);
  State& state = vocabulary.model.components[component].states.emplace_back();
  state.name = name;
  state.kind = one_of<StateKind>(entry.at("kind"), {{"complex", StateKind::complex},
                                                    {"simple", StateKind::simple},
                                                    {"error", StateKind::error},
                                                    {"default", StateKind::resting}});
  if (const auto parameters = entry.find("parameters")) state.parameters = vocabulary.variables(*parameters);
}

model::Command read_command(const Entry& entry, const State& state, const std::string& robot) {
  entry.allow_only({"owner", "robot", "component", "command", "arguments", "answer_within_s"});
  model::Command out;
  out.owner = entry.at("owner").text();
  out.robot = entry.text_or("robot", robot);
  out.subsystem = entry.text_or("component", "");
  out.name = entry.at("command").text();
  if (out.owner.empty() || out.name.empty())
    entry.fail("a command has an owner and a name; add what is missing");
  if (const auto arguments = entry.find("arguments")) {
    for (const auto& [name, value] : fields(*arguments, model::kMostInList)) {
      model::Argument& argument = out.arguments.emplace_back();
      argument.name = name;
      argument.text = value.text();
      const auto dot = argument.text.find('.');
      const auto parameter =
          std::ranges::find(state.parameters, argument.text.substr(0, dot), &Variable::name);
      if (parameter == state.parameters.end()) continue;
      argument.term = Term{static_cast<Index>(parameter - state.parameters.begin()), false};
      if (dot == std::string::npos) continue;
      argument.property = argument.text.substr(dot + 1);
      if (argument.property.empty())
        value.fail("'" + argument.text + "' names no property; write one behind the dot, or drop the dot");
    }
  }
  if (const auto within = entry.find("answer_within_s")) {
    const double seconds = within->number();
    if (seconds <= 0 || seconds > temporal::to_seconds(model::kLongestDuration))
      within->fail("expected seconds above 0; write how long the first answer may take");
    out.answer_within = temporal::seconds(seconds);
  }
  return out;
}

// "12", "[5, 10]": shortest and longest.
void read_duration(const Entry& entry, State& state, Scope& scope, const Vocabulary& vocabulary) {
  if (!entry.is_sequence()) {
    state.shortest = state.longest = vocabulary.bound(entry, scope);
    return;
  }
  const auto both = entry.items();
  if (both.size() != 2) entry.fail("expected one duration, or [shortest, longest]");
  state.shortest = vocabulary.bound(both[0], scope);
  state.longest = vocabulary.bound(both[1], scope);
}

model::Observed read_observed(const Entry& entry, const State& state) {
  entry.allow_only({"timeline", "value"});
  model::Observed out;
  out.timeline = entry.at("timeline").text();
  const auto value = entry.find("value");
  if (!value) {  // the state as it is
    out.word = state.name;
    for (Index i = 0; i < state.parameters.size(); ++i) out.terms.push_back({i, false});
    return out;
  }
  Line line(*value);
  if (!line.at_name()) {
    const auto number = line.number();
    if (!number) line.fail("expected a state, true, false or a number");
    out.word = value->text();
    line.expect_end();
    return out;
  }
  const Application application = line.application();
  line.expect_end();
  out.word = application.name;
  for (const std::string& argument : application.arguments) {
    const auto parameter = std::ranges::find(state.parameters, argument, &Variable::name);
    if (parameter == state.parameters.end())
      line.fail("'" + argument + "' is no parameter of '" + state.name + "'; name one");
    out.terms.push_back({static_cast<Index>(parameter - state.parameters.begin()), false});
  }
  return out;
}

void read_needs(const Entry& list, State& state, Scope& scope, const Vocabulary& vocabulary) {
  for (const Entry& one : one_or_more(list, model::kMostInList)) {
    one.attempt([&] {
      Line line(one);
      model::Need need;
      if (line.take_word("during")) {
        need.kind = NeedKind::during;
      } else if (line.take_word("at_start")) {
        need.kind = NeedKind::at_start;
      } else if (line.take_word("met_by")) {
        need.kind = NeedKind::met_by;
      } else {
        line.fail("expected 'during', 'at_start' or 'met_by' before '" + line.rest() + "'");
      }
      need.state = vocabulary.pattern(line, scope);
      line.expect_end();
      state.needs.push_back(std::move(need));
    });
  }
}

void define_state(const Entry& entry, Index component, Index index, Vocabulary& vocabulary) {
  entry.allow_only({"kind", "parameters", "where", "duration_s", "command", "needs", "observed",
                    "contingency", "retries"});
  State state = vocabulary.model.components[component].states[index];
  Scope scope{state.parameters, false};
  state.where = vocabulary.tests(entry, scope);
  for (const char* key : {"duration_s", "command", "retries", "needs"})
    if (state.kind == StateKind::complex && entry.find(key))
      entry.at(key).fail("a complex state has no '" + std::string(key) + "': its parts have; take it out");
  for (const char* key : {"duration_s", "command", "retries"})
    if (state.kind == StateKind::error && entry.find(key))
      entry.at(key).fail("an error state has no '" + std::string(key) + "'; take it out");
  if (const auto duration = entry.find("duration_s")) read_duration(*duration, state, scope, vocabulary);
  if (state.kind == StateKind::resting && !state.longest.empty())
    entry.at("duration_s")
        .fail("a default state lasts as long as nothing else is asked; write [shortest, none]");
  if (const auto command = entry.find("command"))
    state.command = read_command(*command, state, vocabulary.model.components[component].robot);
  if (const auto needs = entry.find("needs")) {
    scope.grows = true;
    read_needs(*needs, state, scope, vocabulary);
    state.free.assign(scope.variables.begin() + static_cast<std::ptrdiff_t>(state.parameters.size()),
                      scope.variables.end());
  }
  if (const auto observed = entry.find("observed")) state.observed = read_observed(*observed, state);
  state.contingency = entry.text_or("contingency", "");
  if (const auto retries = entry.find("retries")) {
    const std::int64_t count = retries->integer();
    if (count < 0 || count > 1000) retries->fail("expected a whole number from 0 to 1000");
    state.retries = static_cast<std::uint32_t>(count);
  }
  vocabulary.model.components[component].states[index] = std::move(state);
}

// "at(x) -> driving(x, y), idle", or "<->" for both ways.
void read_transition(const Entry& entry, Index component, Vocabulary& vocabulary) {
  Line line(entry);
  Scope from_scope{{}, true};
  const model::Pattern from = vocabulary.pattern_of(component, line, from_scope);
  const bool both = line.take("<->");
  if (!both) line.expect("->");
  auto& transitions = vocabulary.model.components[component].transitions;
  do {
    Scope scope = from_scope;
    const model::Pattern to = vocabulary.pattern_of(component, line, scope);
    transitions.push_back({from.state, from.terms, to.state, to.terms, scope.variables});
    if (both) transitions.push_back({to.state, to.terms, from.state, from.terms, scope.variables});
  } while (line.take(","));
  line.expect_end();
  if (transitions.size() > model::kMostTransitions)
    entry.fail("more than " + std::to_string(model::kMostTransitions) + " transitions; use parameters");
}

}  // namespace

void declare_components(const Entry& section, Vocabulary& vocabulary, Places& places) {
  section.each_field([&](const std::string& name, const Entry& entry) {
    if (vocabulary.components.size() >= model::kMostComponents)
      entry.fail("more than " + std::to_string(model::kMostComponents) +
                 " components; plan for fewer at once");
    vocabulary.components.add(name, entry);
    const auto index = static_cast<Index>(vocabulary.model.components.size());
    model::Component& component = vocabulary.model.components.emplace_back();
    vocabulary.states.emplace_back("state");
    places[{model::Part::component, index, 0}] = entry.place();
    component.name = name;
    entry.attempt([&] {
      component.layer =
          one_of<Layer>(entry.at("layer"), {{"abstract", Layer::abstract}, {"primitive", Layer::primitive}});
    });
    component.robot = entry.text_or("robot", "");
    for (const auto& [state, value] : fields(entry.at("states"), model::kMostStates)) {
      value.attempt([&, &state = state, &value = value] {
        declare_state(state, value, index, vocabulary);
        places[{model::Part::state, index,
                static_cast<Index>(vocabulary.model.components[index].states.size() - 1)}] = value.place();
      });
    }
  });
}

void define_components(const Entry& section, Vocabulary& vocabulary) {
  section.each_field([&](const std::string& name, const Entry& entry) {
    entry.allow_only({"layer", "robot", "states", "transitions"});
    const auto index = vocabulary.components.find(name);
    if (!index) return;  // its fault is noted
    for (const auto& [state_name, value] : fields(entry.at("states"), model::kMostStates)) {
      const auto state = vocabulary.states[*index].find(state_name);
      if (!state || *state >= vocabulary.model.components[*index].states.size()) continue;
      value.attempt([&, &value = value] { define_state(value, *index, *state, vocabulary); });
    }
    if (const auto transitions = entry.find("transitions"))
      for (const Entry& one : one_or_more(*transitions, model::kMostTransitions))
        one.attempt([&] { read_transition(one, *index, vocabulary); });
  });
}

}  // namespace roci::planner::timeline_htn::reading
