#include "rehearsal/check/scenario_check.hpp"

#include <algorithm>
#include <map>
#include <variant>

#include "core/words/nearest_word.hpp"
#include "rehearsal/check/event_codes.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using exec::goals::GoalRequest, exec::goals::GoalSet;
using exec::mission::Addressee;
using mission::Entry;
using sim::scenario::GoalStimulus, sim::scenario::Stimulus;

namespace {

constexpr char kRejected[] = "goal.rejected";

bool expects(const CheckedScenario& scenario, std::string_view code) {
  return std::ranges::any_of(scenario.run.scenario.expect,
                             [&](const auto& event) { return event.code == code; });
}

// Whether the file names the kind, although it could not be read: that was told there.
bool is_unread(const CheckedExecutive& executive, const std::string& kind) {
  const auto kinds = executive.file.find("goal_kinds");
  return kinds && kinds->is_mapping() && kinds->find(kind) && !executive.model.goal_kinds.contains(kind);
}

class GoalCheck {
 public:
  GoalCheck(const CheckedMission& mission, const CheckedScenario& scenario)
      : mission_(mission), rejects_(expects(scenario, kRejected)) {}

  void submit(const GoalStimulus& goal, temporal::Time at) {
    for (const CheckedExecutive& executive : mission_.executives) {
      const auto whose = addressee(executive.model.role, goal.robot);
      if (whose == Addressee::another || is_unread(executive, goal.kind)) continue;
      GoalSet& set = sets_.try_emplace(executive.service, executive.model).first->second;
      const auto taken = set.submit(request_of(goal), at);
      const bool refused =
          taken.taken == GoalSet::Disposition::rejected || taken.taken == GoalSet::Disposition::refused;
      if (!refused || rejects_) continue;
      goal.entry->complain("goal '" + goal.id + "' will be rejected: " + taken.record->reason +
                           nearest_kind(goal, executive) + remedy(taken.record->reason));
    }
  }

 private:
  static std::string nearest_kind(const GoalStimulus& goal, const CheckedExecutive& executive) {
    std::vector<std::string> kinds;
    for (const auto& [name, kind] : executive.model.goal_kinds) kinds.push_back(name);
    return contains(kinds, goal.kind) ? "" : words::did_you_mean(goal.kind, kinds);
  }
  static std::string remedy(const std::string& reason) {
    return reason.find("; ") == std::string::npos
               ? "; correct it, or expect goal.rejected where that is meant"
               : "";
  }

  const CheckedMission& mission_;
  bool rejects_;
  std::map<std::string, GoalSet> sets_;
};

void check_goals(const CheckedMission& mission, const CheckedScenario& scenario) {
  GoalCheck check(mission, scenario);
  for (const Stimulus& stimulus : scenario.run.scenario.stimuli)
    if (const auto* goal = std::get_if<GoalStimulus>(&stimulus.what)) check.submit(*goal, stimulus.at);
}

void check_windows_of(const CheckedMission& mission, const CheckedScenario& scenario) {
  std::vector<std::string> known = mission.windows();
  for (const SimulatedComponent& component : mission.world.components)
    known.insert(known.end(), component.windows.begin(), component.windows.end());
  const auto windows = scenario.file.find("windows");
  if (!windows || !windows->is_sequence()) return;
  windows->each([&](const Entry& window) {
    const Entry timeline = window.at("timeline");
    if (contains(known, timeline.text())) return;
    timeline.fail("the mission has no window '" + timeline.text() + "', so that this one opens nothing; " +
                  instead_of(timeline.text(), known));
  });
}

void check_expected(const CheckedMission& mission, const CheckedScenario& scenario) {
  const auto expect = scenario.file.find("expect");
  if (!expect || !expect->is_sequence()) return;
  expect->each([&](const Entry& item) {
    if (item.is_mapping() && item.fields().empty()) return;
    std::string code = item.is_mapping() ? item.fields().front().first : item.text();
    if (code.ends_with('+')) code.pop_back();
    if (code.empty() || contains(event_codes(), code)) return;
    if (!mission.closed && words::nearest_word(code, event_codes()).empty())
      return;  // of a program of its owner
    item.fail("no service tells of an event '" + code + "'; " + instead_of(code, event_codes()));
  });
}

// The state in which each component begins must be one that the mission knows.
void check_starts(const CheckedMission& mission, const CheckedScenario& scenario) {
  const SimulatedWorld begun = simulated_world(scenario.run, mission.world.service);
  const auto start = scenario.file.find("start");
  for (const CheckedExecutive& executive : mission.executives) {
    for (const exec::mission::Component& component : executive.model.components) {
      const SimulatedComponent* usual = mission.world.on_timeline(component.timeline);
      const SimulatedComponent* now = begun.on_timeline(component.timeline);
      if (!start || usual == nullptr || now == nullptr || component.owner != mission.world.service) continue;
      for (const auto& state : now->states) {
        if (contains(names_of(usual->states), state.name)) continue;
        std::vector<std::string> known;
        for (const auto& one : component.states) known.push_back(one.name);
        if (contains(known, state.name)) continue;
        start->complain("'" + now->timeline() + "' would begin in a state '" + state.name +
                        "' that the mission does not know; " + instead_of(state.name, known));
      }
    }
  }
}

}  // namespace

GoalRequest request_of(const GoalStimulus& goal) {
  GoalRequest out;
  out.key = {goal.issuer, goal.id};
  out.robot = goal.robot;
  out.kind = goal.kind;
  out.arguments.insert(goal.arguments.begin(), goal.arguments.end());
  out.opens = goal.opens;
  out.closes = goal.closes;
  return out;
}

void check_scenario(const CheckedMission& mission, const CheckedScenario& scenario) {
  check_goals(mission, scenario);
  check_windows_of(mission, scenario);
  check_starts(mission, scenario);
  check_expected(mission, scenario);
}

}  // namespace roci::rehearsal::check
