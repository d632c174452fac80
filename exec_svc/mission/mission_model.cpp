#include "exec_svc/mission/mission_model.hpp"

#include <fstream>
#include <sstream>

#include "core/mission/entry.hpp"
#include "core/mission/scenario.hpp"
#include "exec_svc/mission/action_entries.hpp"
#include "exec_svc/mission/domain_names.hpp"

namespace roci::exec::mission {
namespace {

using roci::mission::Entry;
using temporal::Duration;

Duration seconds(const Entry& entry) { return temporal::seconds(entry.number()); }

Duration seconds_or(const Entry& parent, const char* key, double fallback_s) {
  return temporal::seconds(parent.number_or(key, fallback_s));
}

std::vector<std::string> texts_or_none(const Entry& parent, const char* key) {
  const auto entry = parent.find(key);
  return entry ? entry->texts() : std::vector<std::string>{};
}

std::string whole_file(const Entry& name) {
  const auto path = name.resolve(name.text());
  std::ifstream in(path);
  if (!in) name.fail("cannot read " + path.string() + "; check the name");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<StateModel> read_states(const Entry& states) {
  std::vector<StateModel> out;
  for (const auto& [name, entry] : states.fields()) {
    entry.allow_only({"active", "facts"});
    out.push_back({name, entry.truth_or("active", false), texts_or_none(entry, "facts")});
  }
  return out;
}

Component read_component(const Entry& entry) {
  entry.allow_only({"name", "timeline", "owner", "fallback", "states"});
  Component out{entry.at("name").text(), entry.at("timeline").text(), entry.at("owner").text(),
                entry.text_or("fallback", ""), read_states(entry.at("states"))};
  bool has_inactive = false;
  bool has_active = false;
  for (const StateModel& state : out.states) (state.active ? has_active : has_inactive) = true;
  if (!has_inactive)
    entry.at("states").fail("component '" + out.name + "' has no inactive state; planning needs one (R43)");
  if (has_active && out.fallback.empty()) {
    entry.fail("component '" + out.name + "' has active states; name the 'fallback' command that ends them");
  }
  return out;
}

TimelineFamily read_family(const Entry& entry) {
  entry.allow_only({"timeline", "states"});
  std::string pattern = entry.at("timeline").text();
  if (pattern.empty() || pattern.back() != '*')
    entry.at("timeline").fail("expected a name that ends in *, e.g. image.*");
  pattern.pop_back();
  TimelineFamily out{pattern, read_states(entry.at("states"))};
  for (const StateModel& state : out.states) {
    if (state.active)
      entry.fail("states of a family are inactive; make '" + state.name + "' a component's state");
  }
  return out;
}

FluentSource read_fluent(const Entry& entry) {
  entry.allow_only({"fluent", "timeline", "value", "last"});
  FluentSource out;
  out.fluent = entry.at("fluent").text();
  if (const auto timeline = entry.find("timeline")) {
    out.timeline = timeline->text();
  } else {
    out.value = entry.at("value").number();
    if (const auto last = entry.find("last")) out.last = last->number();
  }
  return out;
}

WindowModel read_window(const Entry& entry) {
  entry.allow_only({"fact", "timeline", "open"});
  WindowModel out{entry.at("fact").text(), entry.text_or("timeline", ""), {}};
  for (const Entry& item : entry.at("open").items()) {
    const auto ends = item.items();
    if (ends.size() != 2) item.fail("expected [from, to] in seconds");
    const auto from = seconds(ends[0]);
    const auto to = seconds(ends[1]);
    if (to <= from) item.fail("the window ends before it begins; write [from, to] with from < to");
    if (!out.open.empty() && from <= out.open.back().second) {
      item.fail("windows must be in ascending order and must not touch; merge or reorder them");
    }
    out.open.emplace_back(from, to);
  }
  return out;
}

ObjectModel read_object(const Entry& entry) {
  entry.allow_only({"name", "type", "dynamic", "properties"});
  ObjectModel out{entry.at("name").text(), entry.at("type").text(), entry.truth_or("dynamic", false), {}};
  if (const auto properties = entry.find("properties")) {
    for (const auto& [name, value] : properties->fields()) {
      PropertySource source{name, "", std::nullopt};
      if (value.is_mapping()) {
        value.allow_only({"timeline"});
        source.timeline = value.at("timeline").text();
      } else {
        source.text = value.text();
      }
      out.properties.push_back(std::move(source));
    }
  }
  return out;
}

std::vector<ObjectModel> read_objects(const Entry& parent) {
  std::vector<ObjectModel> out;
  if (const auto list = parent.find("objects")) {
    for (const Entry& item : list->items()) out.push_back(read_object(item));
  }
  return out;
}

ArgumentKind read_argument_kind(const Entry& entry) {
  const std::string text = entry.text();
  if (text == "number") return ArgumentKind::number;
  if (text == "text") return ArgumentKind::text;
  if (text == "goal") return ArgumentKind::goal;
  entry.fail("unknown kind of argument '" + text + "'; one of: number, text, goal");
}

GoalKind read_goal_kind(const std::string& name, const Entry& entry) {
  entry.allow_only({"help", "arguments", "objects", "facts", "unobserved", "window", "goal"});
  GoalKind out;
  out.name = name;
  out.help = entry.text_or("help", "");
  if (const auto arguments = entry.find("arguments")) {
    for (const auto& [argument, kind] : arguments->fields())
      out.arguments[argument] = read_argument_kind(kind);
  }
  out.objects = read_objects(entry);
  out.facts = texts_or_none(entry, "facts");
  if (const auto unobserved = entry.find("unobserved")) {
    for (const Entry& item : unobserved->items()) {
      item.allow_only({"timeline", "facts"});
      out.unobserved.emplace_back(item.at("timeline").text(), item.at("facts").texts());
    }
  }
  out.window_fact = entry.text_or("window", "");
  out.goal = entry.at("goal").texts();
  if (out.goal.empty()) entry.at("goal").fail("a goal kind needs at least one goal fact");
  return out;
}

PlannerSettings read_planner(const Entry& entry) {
  PlannerSettings out;
  out.engine = entry.text_or("engine", out.engine);
  if (const auto budget = entry.find("budget")) {
    budget->allow_only({"work", "memory_mb", "wall_s"});
    out.work = static_cast<std::uint64_t>(budget->number_or("work", 0));
    out.memory_mb = static_cast<std::uint32_t>(budget->number_or("memory_mb", 0));
    out.wall = seconds_or(*budget, "wall_s", 0);
  }
  out.allowance = seconds_or(entry, "allowance_s", temporal::to_seconds(out.allowance));
  out.reply_timeout = seconds_or(entry, "reply_timeout_s", temporal::to_seconds(out.reply_timeout));
  return out;
}

constexpr Duration kShortestTerm = temporal::seconds(0.5);

ReactorSettings read_executive(const Entry& entry) {
  entry.allow_only({"ack_timeout_s", "fallback_timeout_s", "replan_limit", "call_retries", "failure_limit",
                    "failure_pause_s", "failure_pause_max_s", "keep_inputs", "recovery", "start",
                    "replanning", "standby_term_s"});
  ReactorSettings out;
  out.ack_timeout = seconds_or(entry, "ack_timeout_s", temporal::to_seconds(out.ack_timeout));
  out.fallback_timeout = seconds_or(entry, "fallback_timeout_s", temporal::to_seconds(out.fallback_timeout));
  out.replan_limit = count_or(entry, "replan_limit", out.replan_limit, 0);
  out.call_retries = count_or(entry, "call_retries", out.call_retries, 0);
  out.failure_limit = count_or(entry, "failure_limit", out.failure_limit, 1);
  out.failure_pause = seconds_or(entry, "failure_pause_s", temporal::to_seconds(out.failure_pause));
  out.failure_pause_max =
      seconds_or(entry, "failure_pause_max_s", temporal::to_seconds(out.failure_pause_max));
  out.keep_inputs = entry.truth_or("keep_inputs", out.keep_inputs);
  if (const auto recovery = entry.find("recovery")) out.recovery = read_strategy(*recovery);
  if (const auto start = entry.find("start")) out.start = read_start(*start);
  if (const auto replanning = entry.find("replanning")) out.replanning = read_replanning(*replanning);
  out.standby_term = seconds_or(entry, "standby_term_s", temporal::to_seconds(out.standby_term));
  if (out.standby_term < kShortestTerm)
    entry.at("standby_term_s").fail("a member's words would come too late for it; give at least 0.5 s");
  return out;
}

}  // namespace

MissionModel read_mission(const std::filesystem::path& mission_folder) {
  const Entry root = Entry::load(roci::mission::mission_file(mission_folder));
  MissionModel out;
  out.name = root.at("name").text();
  out.domain_text = whole_file(root.at("domain"));
  const pddl::Domain domain = read_domain(out.domain_text, root.resolve(root.at("domain").text()).string());
  out.domain_name = domain.name;
  out.objects = read_objects(root);
  for (const Entry& item : root.at("components").items()) out.components.push_back(read_component(item));
  if (const auto list = root.find("families")) {
    for (const Entry& item : list->items()) out.families.push_back(read_family(item));
  }
  if (const auto list = root.find("fluents")) {
    for (const Entry& item : list->items()) out.fluents.push_back(read_fluent(item));
  }
  if (const auto list = root.find("windows")) {
    for (const Entry& item : list->items()) out.windows.push_back(read_window(item));
  }
  if (const auto contingencies = root.find("contingencies")) {
    for (const auto& [name, entry] : contingencies->fields())
      out.contingencies[name] = read_contingency(name, entry, out.components);
  }
  for (const auto& [name, entry] : root.at("actions").fields()) {
    out.actions[name] = read_action(entry, out.components, out.contingencies);
  }
  for (const auto& [name, entry] : root.at("goal_kinds").fields()) {
    out.goal_kinds[name] = read_goal_kind(name, entry);
  }
  require_domain_names(root, domain);
  out.planner = read_planner(root.at("planner"));
  if (const auto executive = root.find("executive")) out.executive = read_executive(*executive);
  if (const auto ground = root.find("ground")) out.ground = read_ground(*ground, out.contingencies);
  return out;
}

}  // namespace roci::exec::mission
