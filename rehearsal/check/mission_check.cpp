#include "rehearsal/check/mission_check.hpp"

#include <algorithm>
#include <exception>
#include <functional>
#include <map>
#include <optional>

#include "core/mission/mission_file.hpp"
#include "core/mission/scenario.hpp"
#include "core/pddl/ast.hpp"
#include "core/temporal/value.hpp"
#include "core/words/nearest_word.hpp"
#include "planner_svc/settings.hpp"
#include "rehearsal/check/action_check.hpp"
#include "rehearsal/check/component_check.hpp"
#include "rehearsal/check/goal_kind_check.hpp"
#include "rehearsal/check/map_check.hpp"
#include "rehearsal/check/scenario_check.hpp"
#include "rehearsal/check/words.hpp"
#include "rehearsal/flight.hpp"
#include "science_svc/detector_file.hpp"
#include "science_svc/watch/watch_file.hpp"
#include "services/link/link_file.hpp"

namespace roci::rehearsal::check {

using mission::Entry, mission::Findings;

namespace {

constexpr char kSimulator[] = "sim_svc";

// Runs a part of the reading; what it throws is a finding.
void note(Findings& findings, const std::function<void()>& read) {
  try {
    read();
  } catch (const std::exception& error) {
    findings.add(error.what());
  }
}

std::string program_of(const mission::ServiceEntry& entry) {
  return std::filesystem::path(entry.program).filename();
}

bool is_linked(const mission::ServiceEntry& entry) {
  return entry.program.find('/') == std::string::npos &&
         std::ranges::find(programs(), entry.program, &Program::name) != programs().end();
}

// A program that is none of ours must stand beside roci-launch.
void check_programs(const CheckedMission& mission) {
  std::vector<std::string> known;
  for (const Program& one : programs()) known.push_back(one.name);
  std::error_code error;
  const auto bin = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  mission.file.at("services").each([&](const Entry& entry) {
    const Entry program = entry.find("program").value_or(entry.at("name"));
    const std::string name = program.text();
    if (name.find('/') != std::string::npos || contains(known, name) ||
        std::filesystem::exists(bin / name, error))
      return;
    program.fail("there is no program '" + name + "' beside roci-launch; " + instead_of(name, known));
  });
}

// The simulated clock is the simulator's, and without it no scenario is flown.
void check_clock_master(const CheckedMission& mission, bool has_scenarios) {
  const mission::ServiceEntry* master = mission.services.clock_master();
  mission.file.at("services").each([&](const Entry& entry) {
    const mission::ServiceEntry* service = mission.services.find(entry.at("name").text());
    if (service == nullptr) return;
    const bool simulates = program_of(*service) == kSimulator;
    if (master == nullptr && simulates)
      entry.complain(
          "no service has clock: master, so that the mission could only be flown live; add it here");
    if (service == master && !simulates && is_linked(*service))
      entry.at("clock").complain(
          "'" + program_of(*service) +
          "' simulates nothing, and a clock that it drives brings no scenario about; give "
          "clock: master to the service with the program sim_svc");
  });
  if (master == nullptr && has_scenarios && mission.services.of_program(kSimulator).empty())
    mission.file.at("services")
        .complain(
            "the mission has scenarios, and no service that has clock: master to fly them; add for "
            "example {name: sim_svc, clock: master}, or drop the scenarios");
}

void read_executives(CheckedMission& out, Findings& findings) {
  for (const mission::ServiceEntry* entry : out.services.of_program("exec_svc")) {
    note(findings, [&] {
      const auto role = exec::mission::role_of(out.services, entry->name, entry->robot);
      Entry file = mission::load_mission_file(entry->settings, &findings);
      out.executives.push_back(
          {entry->name, std::move(file), read_mission(entry->settings, role, &findings)});
    });
  }
}

// Reads what stands in a scenario for services other than the simulator, too.
void read_scenario(CheckedMission& mission, const std::string& name, bool simulated, Findings& findings) {
  const std::size_t before = findings.size();
  note(findings, [&] {
    CheckedScenario scenario{name, mission::load_scenario(mission.folder, name, &findings), {}};
    note(findings, [&] { services::link::read_links(scenario.file, mission.services, 1); });
    note(findings, [&] {
      for (const std::string& warning : science::read_detector(mission.file, scenario.file).warnings)
        findings.add(warning, mission::Severity::warning);
    });
    if (!simulated) return;
    scenario.run =
        sim::scenario::load_run(mission.folder, name, sim::components::standard_types(), &findings);
    scenario.sound = findings.size() == before;
    mission.scenarios.push_back(std::move(scenario));
  });
}

// What was read with a warning.
void note_warnings(const CheckedMission& mission, Findings& findings) {
  for (const CheckedExecutive& executive : mission.executives) {
    if (!executive.model.domain) continue;
    for (const pddl::Diagnostic& one : executive.model.domain->warnings)
      findings.add(
          {one.file, one.where.line, one.where.column, mission::Severity::warning, one.message, one.remedy});
  }
}

void check_science(const CheckedMission& mission) {
  if (mission.services.of_program("science_svc").empty()) return;
  const auto section = mission.file.find("science");
  const auto kind = section && section->is_mapping() ? section->find("goal_kind") : std::nullopt;
  if (!kind) return;
  std::vector<std::string> known;
  for (const CheckedExecutive& executive : mission.executives)
    for (const auto& [name, one] : executive.model.goal_kinds) known.push_back(name);
  if (!contains(known, kind->text()))
    kind->complain("the mission has no goal kind '" + kind->text() + "'; " + instead_of(kind->text(), known));
}

// What the watch asks for must be what an executive understands.
void check_watch(const CheckedMission& mission) {
  const auto list = mission.file.find("watch");
  if (!list) return;
  science::watch::read_rules(mission.file);
  if (mission.services.of_program("science_svc").empty())
    list->complain("nobody watches: the mission has no science_svc; add it to 'services', or drop 'watch'");
  std::map<std::string, const exec::mission::GoalKind*> kinds;
  std::vector<std::string> known;
  for (const CheckedExecutive& executive : mission.executives)
    for (const auto& [name, kind] : executive.model.goal_kinds) {
      kinds.emplace(name, &kind);
      known.push_back(name);
    }
  list->each([&](const Entry& rule) {
    const Entry name = rule.at("goal_kind");
    const auto kind = kinds.find(name.text());
    if (kind == kinds.end())
      name.fail("the mission has no goal kind '" + name.text() + "'; " + instead_of(name.text(), known));
    const auto arguments = rule.find("arguments");
    for (const auto& [argument, type] : kind->second->arguments)
      if (!arguments || !arguments->find(argument))
        rule.complain("argument '" + argument + "' of goal kind " + name.text() +
                      " is missing; add it to 'arguments'");
    if (!arguments) return;
    std::vector<std::string> taken;
    for (const auto& [argument, type] : kind->second->arguments) taken.push_back(argument);
    for (const auto& [argument, value] : arguments->fields())
      if (!contains(taken, argument))
        value.complain("a " + name.text() + " has no argument '" + argument + "'; " +
                       instead_of(argument, taken));
  });
}

// An answer that comes later than it is waited for is lost, and a robot that has lost all of them waits for the ground.
void check_reply_time(const CheckedExecutive& executive) {
  const auto& planner = executive.model.planner;
  const auto entry = executive.file.find("planner");
  const auto budget = entry ? entry->find("budget") : std::nullopt;
  if (!budget || executive.model.executive.plans_continuously()) return;
  const planner::Settings defaults;
  const auto simulated = entry->find("simulated");
  const auto of = [&](const char* name, double otherwise) {
    return simulated ? simulated->number_or(name, otherwise) : otherwise;
  };
  const double longest_s =
      of("base_s", defaults.simulated_base_s) +
      static_cast<double>(planner.work) * of("per_evaluation_s", defaults.simulated_per_evaluation_s);
  const double waits_s = temporal::to_seconds(planner.reply_timeout);
  if (longest_s < waits_s) return;
  const auto told = [](double seconds) { return temporal::to_text(temporal::Value{seconds}) + " s"; };
  budget->complain("a call that spends it takes " + told(longest_s) +
                   " of simulated time, and an answer is waited for " + told(waits_s) +
                   "; give less work, or a longer reply_timeout_s to 'planner'");
}

void check_names(const CheckedMission& mission, Findings& findings) {
  for (const CheckedExecutive& executive : mission.executives) {
    note(findings, [&] { check_reply_time(executive); });
    note(findings, [&] { check_components(mission, executive); });
    note(findings, [&] { check_actions(mission, executive); });
    note(findings, [&] { check_goal_kinds(mission, executive); });
    note(findings, [&] { check_objects_on_map(mission, executive); });
  }
  note(findings, [&] { check_simulation(mission); });
  note(findings, [&] { check_science(mission); });
  note(findings, [&] { check_watch(mission); });
  for (const CheckedScenario& scenario : mission.scenarios) {
    note(findings, [&] { check_scenario(mission, scenario, findings); });
    note(findings, [&] { check_scenario_on_map(mission, scenario, findings); });
  }
}

void plan_goals(const CheckedMission& mission, const std::vector<std::string>& scenarios, CheckReport& out) {
  AskedOwners owners(mission.folder, mission.services, scenarios.empty() ? "nominal" : scenarios.front(),
                     out.findings);
  if (out.findings.errors() > 0) return;
  for (const CheckedExecutive& executive : mission.executives)
    check_functions(mission, executive, owners, out.findings);
  if (out.findings.errors() > 0) return;
  for (const CheckedExecutive& executive : mission.executives) {
    DryPlans plans = dry_plan(mission, executive, owners, out.findings);
    std::ranges::move(plans.planned, std::back_inserter(out.plans.planned));
    std::ranges::move(plans.not_tried, std::back_inserter(out.plans.not_tried));
    std::ranges::move(plans.unachieved, std::back_inserter(out.plans.unachieved));
  }
}

}  // namespace

CheckReport check_mission(const std::filesystem::path& folder, const std::string& scenario) {
  CheckReport out;
  if (!scenario.empty()) mission::load_scenario(folder, scenario);
  std::optional<Entry> file;
  note(out.findings, [&] { file = mission::load_mission_file(folder, &out.findings); });
  if (!file) return out;
  CheckedMission mission{folder, *file, {}, {}, {}, {}};
  note(out.findings, [&] { mission.services = mission::read_service_list(*file); });
  if (mission.services.services.empty()) return out;
  note(out.findings, [&] { check_programs(mission); });
  mission.closed = std::ranges::all_of(mission.services.services, is_linked);
  const auto simulators = mission.services.of_program(kSimulator);
  const bool simulated = !simulators.empty();
  out.scenarios = scenario.empty() ? mission::scenario_names(folder) : std::vector<std::string>{scenario};
  // The usual one first: goals are planned from where it begins.
  std::ranges::stable_partition(out.scenarios, [](const std::string& name) { return name == "nominal"; });
  if (out.scenarios.empty() && simulated)
    file->complain(
        "the mission has no scenario, and a simulated flight needs one; add scenarios/nominal.yaml");
  note(out.findings, [&] { check_clock_master(mission, !out.scenarios.empty()); });
  for (const std::string& name : out.scenarios) read_scenario(mission, name, simulated, out.findings);
  if (simulated && !mission.scenarios.empty())
    mission.world = simulated_world(mission.scenarios.front().run, simulators.front()->name);
  read_executives(mission, out.findings);
  note_warnings(mission, out.findings);
  for (CheckedExecutive& executive : mission.executives) check_engine_model(executive, out.findings);
  check_names(mission, out.findings);
  if (out.findings.errors() == 0) plan_goals(mission, out.scenarios, out);
  return out;
}

}  // namespace roci::rehearsal::check
