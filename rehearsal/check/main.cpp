// roci-check finds what is wrong with a mission without flying it; see README.md in this folder.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "core/mission/entry.hpp"
#include "core/mission/finding_json.hpp"
#include "core/mission/finding_report.hpp"
#include "rehearsal/check/mission_check.hpp"
#include "services/process/mission_folder.hpp"

namespace {

namespace fs = std::filesystem;
namespace check = roci::rehearsal::check;
using roci::mission::Finding;

// docs/exit-codes.md lists these under "Checks".
enum ExitCode { kNothingFound = 0, kFound = 1, kBadInput = 2, kDefect = 3 };

// As seen from the working folder, if it lies below.
std::string short_name(const std::string& file) {
  if (file.empty()) return file;
  const fs::path near = fs::path(file).lexically_normal().lexically_proximate(fs::current_path());
  return near.empty() || *near.begin() == ".." ? file : near.string();
}

nlohmann::json as_json(const check::CheckReport& report, const fs::path& mission) {
  nlohmann::json out{{"mission", mission.filename().string()}, {"scenarios", report.scenarios},
                     {"findings", to_json(report.findings)},   {"planned", nlohmann::json::array()},
                     {"not_planned", nlohmann::json::array()}, {"unachieved", nlohmann::json::array()}};
  for (const check::PlannedKind& one : report.plans.planned)
    out["planned"].push_back(
        {{"kind", one.kind}, {"scenario", one.scenario}, {"goal", one.goal}, {"activities", one.activities}});
  for (const check::UnplannedKind& one : report.plans.not_tried)
    out["not_planned"].push_back({{"kind", one.kind}, {"why", one.why}});
  for (const check::UnachievedKind& one : report.plans.unachieved)
    out["unachieved"].push_back({{"kind", one.kind},
                                 {"scenario", one.scenario},
                                 {"goal", one.goal},
                                 {"verdict", one.verdict},
                                 {"details", one.details}});
  return out;
}

std::string counted(std::size_t count, const std::string& one, const std::string& several) {
  return std::to_string(count) + " " + (count == 1 ? one : several);
}

void print(const check::CheckReport& report, const fs::path& mission, bool why) {
  for (Finding one : report.findings.sorted()) {
    one.file = short_name(one.file);
    std::cout << roci::mission::report(one);
  }
  for (const check::UnachievedKind& one : report.plans.unachieved)
    if (why)
      std::cout << "of goal kind '" << one.kind << "' (goal '" << one.goal << "' of scenario '"
                << one.scenario << "') the planner says: " << one.verdict << ": " << one.details << "\n";
  // Several executives may know the same kind.
  std::set<std::string> planned_kinds;
  for (const check::PlannedKind& one : report.plans.planned) planned_kinds.insert(one.kind);
  std::set<std::pair<std::string, std::string>> unplanned;
  for (const check::UnplannedKind& one : report.plans.not_tried)
    if (unplanned.emplace(one.kind, one.why).second)
      std::cout << "goal kind '" << one.kind << "' was not planned: " << one.why << "\n";
  const std::size_t count = report.findings.size();
  const bool planned = !report.plans.planned.empty() || !report.plans.not_tried.empty();
  std::cout << mission.filename().string() << ": "
            << counted(report.scenarios.size(), "scenario", "scenarios") << " read, "
            << counted(planned_kinds.size(), "goal kind", "goal kinds") << " planned, "
            << (count == 0 ? "nothing found" : counted(count, "finding", "findings"))
            << (planned || count == 0 ? "" : "; goals are planned when nothing else is wrong") << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  std::string name;
  std::string scenario;
  bool json = false;
  bool why = false;
  CLI::App app(
      "Finds what is wrong with a mission without flying it: reads mission.yaml, the files that it names and "
      "every "
      "scenario, asks the owners of functions, and plans a goal of each kind",
      "roci-check");
  app.add_option("mission", name, "Mission folder, or the name of an installed mission")->required();
  app.add_option("--scenario", scenario, "Read this scenario alone (default: all)");
  app.add_flag("--why", why, "Why a goal cannot be planned, in the planner's own words too");
  app.add_flag("--json", json, "One JSON object instead of lines");
  app.footer(
      "Exit code: 0 no error found (warnings may be), 1 errors, 2 wrong command line or no such mission, 3 a "
      "defect of this "
      "program.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kNothingFound : kBadInput;
  }
  try {
    fs::path mission = roci::services::process::mission_folder(name);
    if (!mission.has_filename()) mission = mission.parent_path();  // "." ends in a slash
    const check::CheckReport report = check::check_mission(mission, scenario);
    if (json) {
      std::cout << as_json(report, mission).dump() << "\n";
    } else {
      print(report, mission, why);
    }
    return report.findings.errors() == 0 ? kNothingFound : kFound;
  } catch (const roci::mission::FileError& error) {
    std::cerr << "roci-check: " << error.what() << "\n";
    return kBadInput;
  } catch (const std::invalid_argument& error) {
    std::cerr << "roci-check: " << error.what() << "\n";
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "roci-check: " << error.what() << "\n";
    return kDefect;
  }
}
