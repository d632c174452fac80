#include "rehearsal/check/scenario_check.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <variant>

#include "core/words/nearest_word.hpp"
#include "rehearsal/check/event_codes.hpp"
#include "rehearsal/check/words.hpp"

namespace roci::rehearsal::check {

using exec::goals::GoalRequest, exec::goals::GoalSet;
using exec::mission::Addressee;
using mission::Entry, mission::Findings, mission::Severity;
using sim::scenario::GoalStimulus, sim::scenario::RecallStimulus, sim::scenario::Stimulus;

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

// A second goal of the same id is no goal of its own: it changes the first one.
class RepeatedGoals {
 public:
  explicit RepeatedGoals(Findings& findings) : findings_(findings) {}

  void send(const GoalStimulus& goal, temporal::Time at) {
    const Entry id = goal.entry->at("id");
    const auto [first, is_new] =
        sent_.try_emplace({goal.issuer, goal.id}, Sent{at, mission::finding_of(id.place() + ": .").line});
    if (is_new) return;
    const std::string what =
        "goal '" + goal.id + "' stands in line " + std::to_string(first->second.line) + " already";
    if (at == first->second.at)
      return id.complain(what + ", for the same time, and is changed by this one; give it another id");
    findings_.add(id.place() + ": " + what +
                      ", and is changed by this one; give it another id, if it is to be a goal of its own",
                  Severity::warning);
  }
  // What was recalled may be sent again.
  void recall(const RecallStimulus& recall) { sent_.erase({recall.issuer, recall.id}); }

 private:
  struct Sent {
    temporal::Time at;
    int line;
  };
  Findings& findings_;
  std::map<std::pair<std::string, std::string>, Sent> sent_;
};

void check_goals(const CheckedMission& mission, const CheckedScenario& scenario, Findings& findings) {
  GoalCheck check(mission, scenario);
  RepeatedGoals repeated(findings);
  for (const Stimulus& stimulus : scenario.run.scenario.stimuli) {
    if (const auto* recall = std::get_if<RecallStimulus>(&stimulus.what)) repeated.recall(*recall);
    const auto* goal = std::get_if<GoalStimulus>(&stimulus.what);
    if (goal == nullptr) continue;
    repeated.send(*goal, stimulus.at);
    check.submit(*goal, stimulus.at);
  }
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

// Whether others than the scenario may send goals: who looks at images or watches, and programs of the mission's own.
bool others_send_goals(const CheckedMission& mission) {
  return !mission.closed || !mission.services.of_program("science_svc").empty();
}

// What these events tell begins with "goal ISSUER/ID", and a scenario names the part that it expects.
void check_expected_goal(const CheckedMission& mission, const CheckedScenario& scenario,
                         const std::string& code, const Entry& part) {
  static constexpr std::array kNames{"goal.accepted", "goal.achieved", "goal.recalled", "goal.dropped",
                                     "goal.failed"};
  const std::string text = part.text();
  const std::string name = text.substr(0, text.find_first_of(" :"));
  if (name.empty() || name == "goal" || name == "hard" || !contains({kNames.begin(), kNames.end()}, code))
    return;
  std::vector<std::string> ids;
  for (const Stimulus& stimulus : scenario.run.scenario.stimuli) {
    const auto* goal = std::get_if<GoalStimulus>(&stimulus.what);
    if (goal == nullptr) continue;
    if ((goal->issuer + "/" + goal->id).find(name) != std::string::npos) return;
    ids.push_back(goal->id);
  }
  // The end of a goal is told with its reason, of which this may be a part.
  const bool a_reason = code == "goal.dropped" || code == "goal.failed";
  const bool near = !words::nearest_word(name, ids).empty();
  if (!near && (a_reason || others_send_goals(mission))) return;
  part.fail("the scenario sends no goal '" + name + "', so that this is never told; " +
            instead_of(name, ids));
}

void check_expected(const CheckedMission& mission, const CheckedScenario& scenario) {
  const auto expect = scenario.file.find("expect");
  if (!expect || !expect->is_sequence()) return;
  expect->each([&](const Entry& item) {
    if (item.is_mapping() && item.fields().empty()) return;
    std::string code = item.is_mapping() ? item.fields().front().first : item.text();
    if (code.ends_with('+')) code.pop_back();
    if (item.is_mapping()) check_expected_goal(mission, scenario, code, item.fields().front().second);
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

void check_scenario(const CheckedMission& mission, const CheckedScenario& scenario, Findings& findings) {
  check_goals(mission, scenario, findings);
  check_windows_of(mission, scenario);
  check_starts(mission, scenario);
  check_expected(mission, scenario);
}

}  // namespace roci::rehearsal::check
