#include "sim_svc/components/task_settings.hpp"

#include <algorithm>
#include <limits>

#include "sim_svc/components/argument_slots.hpp"
#include "sim_svc/world/robot.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

constexpr double kFinestResolution = 1e-6;

double at_least(const Entry& entry, double least) {
  const double value = entry.number();
  if (value < least) entry.fail("must be at least " + std::to_string(least) + "; correct the number");
  return value;
}

double number(const Entry& map, std::string_view key, double fallback,
              double least = std::numeric_limits<double>::lowest()) {
  const auto entry = map.find(key);
  return entry ? at_least(*entry, least) : fallback;
}

// Reads a name, or a list of a name and its arguments.
StateTemplate read_state(const Entry& entry) {
  if (!entry.is_sequence()) return {entry.text(), {}};
  std::vector<std::string> words = entry.texts();
  if (words.empty()) entry.fail("a state needs a name; write it first");
  StateTemplate out{words.front(), {}};
  out.arguments.assign(words.begin() + 1, words.end());
  return out;
}

// Reads a state in which braces name arguments of the command.
StateTemplate read_state_of(const Entry& entry, const TaskCommand& command) {
  StateTemplate out = read_state(entry);
  check_slots(entry, out.name, command.name, command.arguments);
  for (const std::string& argument : out.arguments)
    check_slots(entry, argument, command.name, command.arguments);
  return out;
}

std::map<std::string, NumberChange> read_changes(const Entry& entry, const std::vector<TaskNumber>& numbers) {
  std::map<std::string, NumberChange> out;
  for (const auto& [name, change] : entry.fields()) {
    const bool known = std::any_of(numbers.begin(), numbers.end(),
                                   [&, wanted = name](const TaskNumber& one) { return one.name == wanted; });
    if (!known) change.fail("'" + name + "' is none of this component's numbers; add it to 'numbers'");
    change.allow_only({"by", "to"});
    const auto by = change.find("by");
    const auto to = change.find("to");
    if (by.has_value() == to.has_value()) change.fail("expected either by or to; keep one");
    out[name] = by ? NumberChange{by->number(), std::nullopt} : NumberChange{0, to->number()};
  }
  return out;
}

// A thing is family.name; only the name may hold braces.
void check_thing(const std::string& thing, const Entry& entry) {
  const std::size_t dot = thing.find('.');
  const std::size_t name = dot == std::string::npos ? thing.size() : dot + 1;
  if (dot == 0 || name >= thing.size() || thing.find('{') < dot)
    entry.fail("'" + thing + "' is no thing; write family.name, e.g. hole.{hole}");
}

// Reads "hole.{hole}: bored".
std::map<std::string, StateTemplate> read_leaves(const Entry& entry, const TaskCommand& command) {
  std::map<std::string, StateTemplate> out;
  for (const auto& [thing, state] : entry.fields()) {
    check_thing(thing, state);
    check_slots(state, thing, command.name, command.arguments);
    out[thing] = read_state_of(state, command);
  }
  return out;
}

// Reads "hole.h1: untouched", of a thing that has a state from the start.
std::map<std::string, StateTemplate> read_things(const Entry& entry) {
  std::map<std::string, StateTemplate> out;
  for (const auto& [thing, state] : entry.fields()) {
    check_thing(thing, state);
    if (thing.find_first_of("{}") != std::string::npos)
      state.fail("'" + thing + "' has braces, and no command runs at the start; write each thing's name");
    out[thing] = read_state(state);
  }
  return out;
}

TaskCommand read_command(const std::string& name, const Entry& entry,
                         const std::vector<TaskNumber>& numbers) {
  entry.allow_only({"arguments", "duration_s", "duration_noise", "power_w", "gains_j", "gains_within_s",
                    "during", "then", "stopped", "failed", "needs", "changes", "leaves"});
  TaskCommand out;
  out.name = name;
  if (name == world::kStopCommand)
    entry.fail("every component has the command stop; name this one otherwise");
  if (const auto arguments = entry.find("arguments")) out.arguments = arguments->texts();
  out.duration_s = at_least(entry.at("duration_s"), 0);
  out.duration_noise = number(entry, "duration_noise", 0, 0);
  out.power_w = number(entry, "power_w", 0);
  out.gains_j = number(entry, "gains_j", 0, 0);
  if (const auto within = entry.find("gains_within_s")) {
    out.gains_within_s = at_least(*within, 0);
    if (out.gains_j <= 0) within->fail("nothing is to be gained by then; write gains_j beside it");
    if (*out.gains_within_s > out.duration_s) within->fail("is longer than duration_s; write a shorter time");
  }
  if (const auto state = entry.find("during")) out.during = read_state_of(*state, out);
  if (const auto state = entry.find("then")) out.then = read_state_of(*state, out);
  if (const auto state = entry.find("stopped")) out.stopped = read_state_of(*state, out);
  if (const auto state = entry.find("failed")) {
    if (out.gains_j <= 0)
      state->fail("a task fails by itself only if it gains too little; write gains_j beside it");
    out.failed = read_state_of(*state, out);
  }
  if (const auto needs = entry.find("needs")) {
    for (const auto& [component, state] : needs->fields()) out.needs[component] = state.text();
  }
  if (const auto changes = entry.find("changes")) out.changes = read_changes(*changes, numbers);
  if (const auto leaves = entry.find("leaves")) out.leaves = read_leaves(*leaves, out);
  return out;
}

TaskNumber read_number(const std::string& name, const Entry& entry) {
  TaskNumber out{name};
  if (!entry.is_mapping()) {
    out.start = entry.number();
    return out;
  }
  entry.allow_only({"start", "resolution"});
  out.start = number(entry, "start", out.start);
  out.resolution = number(entry, "resolution", out.resolution, kFinestResolution);
  if (out.resolution > 1) entry.at("resolution").fail("must be at most 1; choose a finer one");
  return out;
}

}  // namespace

TaskSettings read_task_settings(Settings& in) {
  TaskSettings out;
  if (const auto state = in.find("state")) out.start = read_state(*state);
  if (const auto& state = in.start()) out.start = read_state(*state);
  if (const auto numbers = in.find("numbers")) {
    for (const auto& [name, entry] : numbers->fields()) out.numbers.push_back(read_number(name, entry));
  }
  if (const auto things = in.find("things")) out.things = read_things(*things);
  if (const auto commands = in.find("commands")) {
    for (const auto& [name, entry] : commands->fields()) {
      out.commands.push_back(read_command(name, entry, out.numbers));
    }
  }
  return out;
}

}  // namespace roci::sim::components
