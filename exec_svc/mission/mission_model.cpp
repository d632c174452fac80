#include "exec_svc/mission/mission_model.hpp"

#include <algorithm>
#include <optional>

#include "core/mission/mission_file.hpp"
#include "core/mission/model_text.hpp"
#include "core/pddl/types.hpp"
#include "exec_svc/mission/action_entries.hpp"
#include "exec_svc/mission/domain_names.hpp"
#include "exec_svc/mission/goal_kind_entries.hpp"

namespace roci::exec::mission {
namespace {

using roci::mission::Entry;
using temporal::Duration;

Duration seconds(const Entry& entry) { return temporal::seconds(entry.number()); }

Duration seconds_or(const Entry& parent, const char* key, double fallback_s) {
  return temporal::seconds(parent.number_or(key, fallback_s));
}

std::vector<StateModel> read_states(const Entry& states, bool has_domain) {
  std::vector<StateModel> out;
  states.each_field([&](const std::string& name, const Entry& entry) {
    StateModel& state = out.emplace_back(StateModel{name, false, {}});
    entry.allow_only({"active", "facts"});
    if (!has_domain) refuse_without_domain(entry, {"facts"});
    state.active = entry.truth_or("active", false);
    if (const auto facts = entry.find("facts")) state.facts = facts->texts();
  });
  return out;
}

LossModel read_loss(const Entry& entry, const Component& component) {
  entry.allow_only({"without", "for_s", "as"});
  LossModel out;
  if (const auto services = entry.find("without")) out.without = services->texts();
  if (out.without.empty()) out.without = {component.owner};
  const Entry time = entry.at("for_s");
  out.after = seconds(time);
  if (out.after <= Duration(0)) time.fail("expected a time above 0 in seconds; correct it");
  const Entry as = entry.at("as");
  const std::vector<std::string> words = as.texts();
  const auto state = words.empty() ? component.states.end()
                                   : std::ranges::find(component.states, words.front(), &StateModel::name);
  if (state == component.states.end() || state->active)
    as.fail("expected [state, argument, …] with an inactive state of '" + component.name + "'; correct it");
  out.as = {words.front(), {words.begin() + 1, words.end()}};
  return out;
}

Component read_component(const Entry& entry, const MissionModel& mission) {
  entry.allow_only({"name", "robot", "timeline", "owner", "fallback", "states", "lost"});
  const std::string robot = entry.text_or("robot", mission.role.robot);
  const bool own = mission.role.robot.empty() || robot == mission.role.robot;
  Component out{robot,
                entry.at("name").text(),
                own ? read_timeline(entry.at("timeline"), mission.role) : entry.at("timeline").text(),
                entry.at("owner").text(),
                entry.text_or("fallback", ""),
                read_states(entry.at("states"), mission.has_domain())};
  bool has_inactive = false;
  bool has_active = false;
  for (const StateModel& state : out.states) (state.active ? has_active : has_inactive) = true;
  if (!has_inactive)
    entry.at("states").complain("component '" + out.name +
                                "' has no inactive state; planning needs one (R43)");
  if (has_active && out.fallback.empty()) {
    entry.complain("component '" + out.name +
                   "' has active states; name the 'fallback' command that ends them");
  }
  if (const auto lost = entry.find("lost")) lost->attempt([&] { out.lost = read_loss(*lost, out); });
  return out;
}

TimelineFamily read_family(const Entry& entry, const MissionModel& mission) {
  entry.allow_only({"timeline", "states"});
  std::string pattern = read_timeline(entry.at("timeline"), mission.role);
  if (pattern.empty() || pattern.back() != '*')
    entry.at("timeline").fail("expected a name that ends in *, e.g. image.*");
  pattern.pop_back();
  TimelineFamily out{pattern, read_states(entry.at("states"), mission.has_domain())};
  for (const StateModel& state : out.states) {
    if (state.active)
      entry.complain("states of a family are inactive; make '" + state.name + "' a component's state");
  }
  return out;
}

FluentSource read_fluent(const Entry& entry, const ExecutiveRole& role) {
  entry.allow_only({"fluent", "timeline", "value", "last"});
  FluentSource out;
  out.fluent = entry.at("fluent").text();
  if (const auto timeline = entry.find("timeline")) {
    out.timeline = read_timeline(*timeline, role);
  } else {
    out.value = entry.at("value").number();
    if (const auto last = entry.find("last")) out.last = last->number();
  }
  return out;
}

WindowModel read_window(const Entry& entry, const MissionModel& mission) {
  entry.allow_only({"fact", "timeline", "open"});
  WindowModel out;
  if (mission.has_domain()) {
    out.fact = entry.at("fact").text();
    if (const auto timeline = entry.find("timeline")) out.timeline = read_timeline(*timeline, mission.role);
  } else {
    refuse_without_domain(entry, {"fact"});
    out.timeline = read_timeline(entry.at("timeline"), mission.role);
  }
  entry.at("open").each([&](const Entry& item) {
    const auto ends = item.items();
    if (ends.size() != 2) item.fail("expected [from, to] in seconds");
    const auto from = seconds(ends[0]);
    const auto to = seconds(ends[1]);
    if (to <= from) item.fail("the window ends before it begins; write [from, to] with from < to");
    if (!out.open.empty() && from <= out.open.back().second) {
      item.fail("windows must be in ascending order and must not touch; merge or reorder them");
    }
    out.open.emplace_back(from, to);
  });
  return out;
}

// Reads an amount of a budget, or returns 0 where none is given.
double amount_or_none(const Entry& budget, const char* key, double most) {
  const auto entry = budget.find(key);
  if (!entry) return 0;
  const double amount = entry->number();
  if (amount < 0 || amount > most)
    entry->fail("a budget cannot be " + entry->text() + "; write a number from 0 (no bound of its own) on");
  return amount;
}

PlannerSettings read_planner(const Entry& entry, const MissionModel& mission) {
  PlannerSettings out;
  if (!mission.has_domain() && !entry.find("engine"))
    entry.fail(
        "without a 'domain' the mission names the engine that plans it; add 'engine: NAME', or the file "
        "under 'domain'");
  out.engine = entry.text_or("engine", out.engine);
  if (const auto service = entry.find("service")) out.service = read_timeline(*service, mission.role);
  if (const auto budget = entry.find("budget")) {
    budget->allow_only({"work", "memory_mb", "wall_s", "improvement"});  // the last one is planner_svc's
    out.work = static_cast<std::uint64_t>(amount_or_none(*budget, "work", 1e15));
    out.memory_mb = static_cast<std::uint32_t>(amount_or_none(*budget, "memory_mb", 1e9));
    out.wall = seconds_or(*budget, "wall_s", 0);
  }
  out.allowance = seconds_or(entry, "allowance_s", temporal::to_seconds(out.allowance));
  out.reply_timeout = seconds_or(entry, "reply_timeout_s", temporal::to_seconds(out.reply_timeout));
  return out;
}

constexpr Duration kShortestTerm = temporal::seconds(0.5);

ReactorSettings read_executive(const Entry& entry) {
  entry.allow_only({"ack_timeout_s", "fallback_timeout_s", "replan_limit", "call_retries", "failure_limit",
                    "failure_pause_s", "failure_pause_max_s", "keep_inputs", "kept_records", "recovery",
                    "start", "replanning", "autonomy", "standby_term_s", "owner_return_s",
                    "hard_goal_trials"});
  ReactorSettings out;
  out.ack_timeout = seconds_or(entry, "ack_timeout_s", temporal::to_seconds(out.ack_timeout));
  out.fallback_timeout = seconds_or(entry, "fallback_timeout_s", temporal::to_seconds(out.fallback_timeout));
  out.owner_return = seconds_or(entry, "owner_return_s", 0);
  out.replan_limit = count_or(entry, "replan_limit", out.replan_limit, 0);
  out.call_retries = count_or(entry, "call_retries", out.call_retries, 0);
  out.failure_limit = count_or(entry, "failure_limit", out.failure_limit, 1);
  out.failure_pause = seconds_or(entry, "failure_pause_s", temporal::to_seconds(out.failure_pause));
  out.failure_pause_max =
      seconds_or(entry, "failure_pause_max_s", temporal::to_seconds(out.failure_pause_max));
  out.hard_goal_trials = count_or(entry, "hard_goal_trials", out.hard_goal_trials, 0);
  out.keep_inputs = entry.truth_or("keep_inputs", out.keep_inputs);
  out.kept_records = count_or(entry, "kept_records", out.kept_records, 0);
  if (const auto recovery = entry.find("recovery")) out.recovery = read_strategy(*recovery);
  if (const auto start = entry.find("start")) out.start = read_start(*start);
  if (const auto replanning = entry.find("replanning")) out.replanning = read_replanning(*replanning);
  if (const auto autonomy = entry.find("autonomy")) out.autonomy = read_autonomy(*autonomy);
  out.standby_term = seconds_or(entry, "standby_term_s", temporal::to_seconds(out.standby_term));
  if (out.standby_term < kShortestTerm)
    entry.at("standby_term_s").fail("a member's words would come too late for it; give at least 0.5 s");
  return out;
}

// Reads the planner's model, and what it means for the rest of the file.
void read_model(const Entry& root, MissionModel& out) {
  const auto domain_file = root.find("domain");
  const auto model_file = root.find("model");
  if (domain_file && model_file)
    model_file->fail(
        "'domain' is the model of an engine that reads PDDL; name 'model' or 'domain', not both");
  if (model_file) out.model_text = roci::mission::model_text(*model_file);
  if (!domain_file) return;
  out.domain_name = "unread";  // with findings: what speaks of it is not doubted
  out.model_text = roci::mission::model_text(*domain_file);
  out.domain = std::make_shared<const pddl::Domain>(
      read_domain(out.model_text, domain_file->resolve(domain_file->text()).string()));
  out.domain_name = out.domain->name;
}

// Removes the components of other robots, which stay until all names are read.
void keep_own(std::vector<Component>& components, const std::string& robot) {
  std::erase_if(components,
                [&](const Component& component) { return !robot.empty() && component.robot != robot; });
}

void read_actions(const Entry& root, MissionModel& out) {
  if (!out.has_domain()) return refuse_without_domain(root, {"actions", "fluents"});
  root.at("actions").each_field([&](const std::string& name, const Entry& entry) {
    out.actions[name] = read_action(entry, out.components, out.contingencies);
  });
}

}  // namespace

MissionModel read_mission(const std::filesystem::path& folder_or_file, const ExecutiveRole& role,
                          roci::mission::Findings* findings) {
  const Entry root = roci::mission::load_mission_file(folder_or_file, findings);
  MissionModel out;
  out.role = role;
  root.attempt([&] { out.name = root.at("name").text(); });
  root.attempt([&] { read_model(root, out); });
  root.attempt([&] { out.objects = read_objects(root, out); });
  if (const auto facts = root.find("facts")) {
    if (!out.has_domain()) refuse_without_domain(root, {"facts"});
    facts->attempt([&] { out.facts = facts->texts(); });
  }
  root.attempt([&] {
    root.at("components").each([&](const Entry& item) {
      out.components.push_back(read_component(item, out));
    });
  });
  if (const auto list = root.find("families"))
    list->each([&](const Entry& item) { out.families.push_back(read_family(item, out)); });
  if (const auto list = root.find("fluents"))
    list->each([&](const Entry& item) { out.fluents.push_back(read_fluent(item, role)); });
  if (const auto list = root.find("windows"))
    list->each([&](const Entry& item) { out.windows.push_back(read_window(item, out)); });
  if (const auto contingencies = root.find("contingencies"))
    contingencies->each_field([&](const std::string& name, const Entry& entry) {
      out.contingencies[name] = read_contingency(name, entry, out.components);
    });
  root.attempt([&] { read_actions(root, out); });
  keep_own(out.components, role.robot);
  root.attempt([&] {
    root.at("goal_kinds").each_field([&](const std::string& name, const Entry& entry) {
      out.goal_kinds[name] = read_goal_kind(name, entry, out);
    });
  });
  if (out.domain) require_domain_names(root, *out.domain);
  root.attempt([&] { out.planner = read_planner(root.at("planner"), out); });
  if (const auto executive = root.find("executive"))
    executive->attempt([&] { out.executive = read_executive(*executive); });
  if (const auto ground = root.find("ground"))
    ground->attempt([&] { out.ground = read_ground(*ground, out.contingencies); });
  return out;
}

std::vector<std::string> objects_of_type(const MissionModel& mission, const std::string& type) {
  std::vector<std::string> out;
  if (!mission.domain) return out;
  const pddl::TypeTree types(*mission.domain);
  for (const pddl::TypedName& constant : mission.domain->constants)
    if (types.accepts({type}, constant.types)) out.push_back(constant.name);
  for (const ObjectModel& object : mission.objects)
    if (!object.dynamic && types.is_a(object.type, type)) out.push_back(object.name);
  return out;
}

std::set<std::string> owners_of(const MissionModel& mission) {
  std::set<std::string> out;
  for (const Component& component : mission.components) out.insert(component.owner);
  return out;
}

}  // namespace roci::exec::mission
