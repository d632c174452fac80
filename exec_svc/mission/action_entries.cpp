#include "exec_svc/mission/action_entries.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

#include "core/words/nearest_word.hpp"

namespace roci::exec::mission {

using executive::Contingency;
using executive::ContingencyCommand;
using executive::StartPolicy;

namespace {

using roci::mission::Entry;

// Reads one of the permitted words.
template <typename Meaning, std::size_t Count>
Meaning read_word(const Entry& entry, const char* what,
                  const std::pair<const char*, Meaning> (&words)[Count]) {
  const std::string text = entry.text();
  std::string known;
  for (const auto& [word, meaning] : words) {
    if (text == word) return meaning;
    known += (known.empty() ? "" : ", ") + std::string(word);
  }
  std::vector<std::string> all;
  for (const auto& [word, meaning] : words) all.emplace_back(word);
  entry.fail("unknown " + std::string(what) + " '" + text + "'; one of: " + known +
             words::did_you_mean(text, all));
}

const Component& read_component(const Entry& entry, const std::vector<Component>& components) {
  const std::string name = entry.text();
  const auto found = std::ranges::find(components, name, &Component::name);
  if (found == components.end()) {
    std::vector<std::string> known;
    for (const Component& component : components) known.push_back(component.name);
    entry.fail("no component '" + name + "' in this mission; declare it under 'components'" +
               words::did_you_mean(name, known));
  }
  return *found;
}

temporal::Duration read_time(const Entry& entry) {
  const double seconds = entry.number();
  if (seconds <= 0) entry.fail("expected a time above 0 in seconds; correct it");
  return temporal::seconds(seconds);
}

}  // namespace

std::uint32_t count_or(const Entry& parent, const char* key, std::uint32_t fallback, std::uint32_t least) {
  const auto entry = parent.find(key);
  if (!entry) return fallback;
  const std::int64_t count = entry->integer();
  if (count < least || count > 1'000'000)
    entry->fail("must be a whole number from " + std::to_string(least) + " to 1000000; correct it");
  return static_cast<std::uint32_t>(count);
}

Contingency read_contingency(const std::string& name, const Entry& entry,
                             const std::vector<Component>& components) {
  entry.allow_only({"commands", "then", "times", "within_s"});
  Contingency out;
  out.name = name;
  for (const Entry& item : entry.at("commands").items()) {
    item.allow_only({"owner", "component", "command", "arguments"});
    const Component& component = read_component(item.at("component"), components);
    ContingencyCommand command{
        item.at("owner").text(), component.name, item.at("command").text(), {}, component.robot};
    if (const auto arguments = item.find("arguments")) {
      for (const auto& [argument, value] : arguments->fields())
        command.arguments.push_back({argument, value.text()});
    }
    out.commands.push_back(std::move(command));
  }
  if (out.commands.empty()) entry.at("commands").fail("a contingency needs at least one command; add it");
  static constexpr std::pair<const char*, bool> ways[]{{"retry", true}, {"replan", false}};
  if (const auto then = entry.find("then")) out.retries = read_word(*then, "way to go on", ways);
  out.times = count_or(entry, "times", out.times, 1);
  if (const auto within = entry.find("within_s")) out.within = read_time(*within);
  return out;
}

ActionBinding read_action(const Entry& entry, const std::vector<Component>& components,
                          const std::map<std::string, Contingency>& contingencies) {
  entry.allow_only({"owner", "component", "command", "arguments", "lateness", "retries", "retry_within_s",
                    "wait_timeout_s", "contingency"});
  ActionBinding out;
  out.owner = entry.at("owner").text();
  const Component& component = read_component(entry.at("component"), components);
  out.robot = component.robot;
  out.component = component.name;
  out.command = entry.at("command").text();
  if (const auto arguments = entry.find("arguments")) {
    for (const auto& [name, value] : arguments->fields()) out.arguments.emplace_back(name, value.text());
  }
  static constexpr std::pair<const char*, temporal::LatenessPolicy> policies[]{
      {"replan", temporal::LatenessPolicy::replan},
      {"push", temporal::LatenessPolicy::push},
      {"deadline", temporal::LatenessPolicy::deadline}};
  if (const auto lateness = entry.find("lateness"))
    out.lateness = read_word(*lateness, "lateness policy", policies);
  out.retries = count_or(entry, "retries", out.retries, 0);
  if (const auto within = entry.find("retry_within_s")) out.retry_within = read_time(*within);
  if (const auto timeout = entry.find("wait_timeout_s"))
    out.wait_timeout = temporal::seconds(timeout->number());
  if (const auto contingency = entry.find("contingency")) {
    out.contingency = contingency->text();
    if (!contingencies.contains(out.contingency))
      contingency->fail("no contingency '" + out.contingency +
                        "' in this mission; declare it under 'contingencies'");
  }
  return out;
}

GroundModel read_ground(const Entry& entry, const std::map<std::string, Contingency>& contingencies) {
  entry.allow_only({"values", "uploads"});
  GroundModel out;
  if (const auto values = entry.find("values")) out.values = values->texts();
  if (const auto uploads = entry.find("uploads")) {
    static constexpr std::string_view prefix = "contingencies.";
    for (const Entry& item : uploads->items()) {
      const std::string target = item.text();
      if (target == "network" || target == "parameters") continue;  // the planner's
      if (!target.starts_with(prefix) || !contingencies.contains(target.substr(prefix.size())))
        item.fail("'" + target +
                  "' is no contingency of this mission; name one as contingencies.NAME, or "
                  "write network or parameters");
      out.uploads.push_back(target);
    }
  }
  return out;
}

RecoveryStrategy read_strategy(const Entry& entry) {
  static constexpr std::pair<const char*, RecoveryStrategy> strategies[]{
      {"cascade", RecoveryStrategy::cascade},
      {"static", RecoveryStrategy::as_planned},
      {"ground", RecoveryStrategy::ground},
      {"fe", RecoveryStrategy::flexible},
      {"replan", RecoveryStrategy::replan}};
  return read_word(entry, "recovery strategy", strategies);
}

StartPolicy read_start(const Entry& entry) {
  static constexpr std::pair<const char*, StartPolicy> policies[]{{"earliest", StartPolicy::earliest},
                                                                  {"latest", StartPolicy::latest}};
  return read_word(entry, "start policy", policies);
}

// E5 is the paper's own: at E4, goals that are raised on board are worked in beside those of the ground. Whose goals
// come is a matter of the mission's services, so both are one here (Z23).
AutonomyLevel read_autonomy(const Entry& entry) {
  static constexpr std::pair<const char*, AutonomyLevel> levels[]{{"E1", AutonomyLevel::e1},
                                                                  {"E2", AutonomyLevel::e2},
                                                                  {"E3", AutonomyLevel::e3},
                                                                  {"E4", AutonomyLevel::e4},
                                                                  {"E5", AutonomyLevel::e4}};
  return read_word(entry, "level of autonomy", levels);
}

const char* to_string(AutonomyLevel level) {
  constexpr std::array names{"E1", "E2", "E3", "E4"};
  return names.at(static_cast<std::size_t>(level));
}

Replanning read_replanning(const Entry& entry) {
  static constexpr std::pair<const char*, Replanning> ways[]{{"paused", Replanning::stop_and_replan},
                                                             {"situated", Replanning::background},
                                                             {"continuous", Replanning::continuous}};
  return read_word(entry, "way of replanning", ways);
}

}  // namespace roci::exec::mission
