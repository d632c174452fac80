#include "exec_svc/mission/goal_kind_entries.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "core/pddl/types.hpp"
#include "core/words/nearest_word.hpp"
#include "exec_svc/mission/condition_entry.hpp"
#include "exec_svc/mission/goal_formula.hpp"
#include "exec_svc/mission/template_text.hpp"

namespace roci::exec::mission {
namespace {

using roci::mission::Entry;
using temporal::ConditionNode;
using temporal::ConditionOp;

constexpr char kRobot[] = "{robot}";

std::vector<std::string> texts_or_none(const Entry& parent, const char* key) {
  const auto entry = parent.find(key);
  return entry ? entry->texts() : std::vector<std::string>{};
}

// Reads an object. For a `template_of_kind` no robot need be known yet, as the goal may say by which robot its
// objects are seen.
ObjectModel read_object(const Entry& entry, bool has_domain, const ExecutiveRole& role,
                        bool template_of_kind) {
  entry.allow_only({"name", "type", "dynamic", "properties"});
  ObjectModel out{entry.at("name").text(),
                  has_domain ? entry.at("type").text() : entry.text_or("type", ""),
                  entry.truth_or("dynamic", false),
                  {}};
  if (const auto properties = entry.find("properties")) {
    for (const auto& [name, value] : properties->fields()) {
      PropertySource source{name, "", std::nullopt};
      if (value.is_mapping()) {
        value.allow_only({"timeline"});
        const Entry timeline = value.at("timeline");
        source.timeline =
            template_of_kind && role.robot.empty() ? timeline.text() : read_timeline(timeline, role);
      } else {
        source.text = value.text();
      }
      out.properties.push_back(std::move(source));
    }
  }
  return out;
}

ArgumentKind read_argument_kind(const Entry& entry, const pddl::Domain* domain) {
  const std::string text = entry.text();
  if (text == "number") return ArgumentKind::number;
  if (text == "text") return ArgumentKind::text;
  if (text == "goal") return ArgumentKind::goal;
  if (domain == nullptr) entry.fail("unknown kind of argument '" + text + "'; one of: number, text, goal");
  if (pddl::TypeTree(*domain).knows(text)) return ArgumentKind::object;
  std::vector<std::string> known{"number", "text", "goal"};
  for (const pddl::TypedName& type : domain->types) known.push_back(type.name);
  entry.fail("unknown kind of argument '" + text +
             "'; one of number, text, goal, or a type of the domain's objects" +
             words::did_you_mean(text, known));
}

// Returns the facts that a state of a component or a family stands for, or nothing if it is none of theirs.
std::optional<std::vector<std::string>> facts_of(const ConditionNode& node, const MissionModel& mission) {
  const auto* state = std::get_if<temporal::State>(&node.operand);
  if (state == nullptr) return std::nullopt;
  const auto in = [&](const std::vector<StateModel>& states, const std::string& object) {
    std::optional<std::vector<std::string>> out;
    const auto model = std::ranges::find(states, state->name, &StateModel::name);
    if (model == states.end()) return out;
    out.emplace();
    for (const std::string& fact : model->facts)
      out->push_back(fill_star(fill_positions(fact, state->arguments), object));
    return out;
  };
  for (const Component& component : mission.components)
    if (component.timeline == node.timeline) return in(component.states, "");
  for (const TimelineFamily& family : mission.families)
    if (node.timeline.starts_with(family.prefix))
      return in(family.states, node.timeline.substr(family.prefix.size()));
  return std::nullopt;
}

// Returns the PDDL goal that a conjunction of states means.
std::vector<std::string> facts_of(const Entry& achieved, const temporal::Condition& condition,
                                  const MissionModel& mission) {
  std::vector<std::string> out;
  for (const ConditionNode& node : condition.nodes) {
    if (node.op == ConditionOp::all_of) continue;
    const auto facts = node.op == ConditionOp::eq ? facts_of(node, mission) : std::nullopt;
    const bool open = facts && std::ranges::any_of(*facts, [](const std::string& fact) {
                        return fact.find('?') != std::string::npos;
                      });
    if (!facts || open)
      achieved.fail(
          "the planner reads facts, and only states of components and families, with all their arguments, "
          "stand for facts; name the facts under 'goal' as well");
    out.insert(out.end(), facts->begin(), facts->end());
  }
  return out;
}

// Returns something for each {name} of the texts of `goal`, so that they can be parsed.
std::map<std::string, std::string> placeholders(const Entry& kind, const pddl::Domain* domain) {
  std::map<std::string, std::string> out{{"id", "id"}, {"robot", "robot"}};
  if (const auto arguments = kind.find("arguments"))
    for (const auto& [name, argument] : arguments->fields())
      out[name] = read_argument_kind(argument, domain) == ArgumentKind::number ? "1" : name;
  return out;
}

void require_robot(const Entry& entry, const std::string& text) {
  if (text.find(kRobot) != std::string::npos)
    entry.fail("'{robot}' stands here, and this executive has no robot; give it one under 'services'");
}

}  // namespace

std::vector<ObjectModel> read_objects(const Entry& root, const MissionModel& mission) {
  std::vector<ObjectModel> out;
  if (const auto list = root.find("objects")) {
    list->each([&](const Entry& item) {
      out.push_back(read_object(item, mission.has_domain(), mission.role, false));
    });
  }
  return out;
}

GoalKind read_goal_kind(const std::string& name, const Entry& entry, const MissionModel& mission) {
  entry.allow_only({"help", "arguments", "example", "objects", "facts", "facts_while_open", "unobserved",
                    "window", "goal", "achieved"});
  GoalKind out;
  out.name = name;
  out.help = entry.text_or("help", "");
  if (const auto arguments = entry.find("arguments")) {
    for (const auto& [argument, kind] : arguments->fields()) {
      out.arguments[argument] = read_argument_kind(kind, mission.domain.get());
      if (out.arguments[argument] == ArgumentKind::object) out.object_types[argument] = kind.text();
    }
  }
  if (const auto example = entry.find("example"))
    for (const auto& [argument, value] : example->fields())
      if (!out.arguments.contains(argument))
        value.fail("a " + name + " has no argument '" + argument + "'; name one of its 'arguments'");
  if (const auto objects = entry.find("objects"))
    objects->each([&](const Entry& item) {
      out.objects.push_back(read_object(item, mission.has_domain(), mission.role, true));
    });
  if (const auto achieved = entry.find("achieved")) {
    out.achieved = read_condition(*achieved);
    if (!mission.role.robot.empty()) out.achieved = fill_names(out.achieved, {{"robot", mission.role.robot}});
  }
  if (!mission.has_domain()) {
    refuse_without_domain(entry, {"facts", "facts_while_open", "unobserved", "window", "goal"});
    if (out.achieved.empty()) entry.at("achieved");
    return out;
  }
  out.facts = texts_or_none(entry, "facts");
  out.facts_while_open = texts_or_none(entry, "facts_while_open");
  if (const auto unobserved = entry.find("unobserved")) {
    for (const Entry& item : unobserved->items()) {
      item.allow_only({"timeline", "facts"});
      out.unobserved.emplace_back(item.at("timeline").text(), item.at("facts").texts());
    }
  }
  out.window_fact = entry.text_or("window", "");
  if (out.achieved.empty() || entry.find("goal")) {
    out.goal = entry.at("goal").texts();
    if (out.goal.empty()) entry.at("goal").fail("a goal kind needs at least one goal fact");
    for (const Entry& item : entry.at("goal").items())
      if (mission.domain && !is_observed_fact(read_goal(item, entry, mission.domain.get()), *mission.domain))
        out.formula = true;
  } else {
    out.goal = facts_of(entry.at("achieved"), out.achieved, mission);
  }
  return out;
}

pddl::Condition read_goal(const Entry& goal, const Entry& kind, const pddl::Domain* domain) {
  try {
    return read_goal_formula(fill_names(goal.text(), placeholders(kind, domain)));
  } catch (const pddl::ParseError& error) {
    goal.fail("'" + goal.text() + "' is no condition of PDDL: " + error.diagnostic().message +
              "; write a fact, \"(sent image-{id})\", or one with not, or, and, or a comparison of numbers");
  }
}

void refuse_without_domain(const Entry& entry, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto found = entry.find(key))
      found->fail("'" + std::string(key) +
                  "' speaks of a PDDL domain, and this mission has none; drop it, or add 'domain: FILE'");
  }
}

std::string read_timeline(const Entry& entry, const ExecutiveRole& role) {
  const std::string text = entry.text();
  if (role.robot.empty()) {
    require_robot(entry, text);
    return text;
  }
  return fill_names(text, {{"robot", role.robot}});
}

}  // namespace roci::exec::mission
