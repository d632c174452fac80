// roci-rehearse flies a mission N times with all services in one process and reports each flight and the
// totals.
#include <CLI/CLI.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "rehearsal/flight.hpp"
#include "rehearsal/loaded.hpp"
#include "rehearsal/statistics.hpp"
#include "services/clock/wall.hpp"
#include "services/process/link_report.hpp"
#include "services/process/mission_folder.hpp"
#include "services/process/number_checks.hpp"
#include "services/process/run_summary.hpp"

namespace {

using roci::rehearsal::FlightOptions;

struct Arguments {
  std::string mission;
  std::string scenario = "nominal";
  std::uint64_t seed = 1;
  int runs = 1;
  std::string speed = "max";
  bool json = false;
  std::string folder;
};

// docs/exit-codes.md lists these under "Runs".
enum ExitCode { kAchieved = 0, kNotAchieved = 1, kBadInput = 2, kServiceFailed = 3 };

nlohmann::json summary_of(const std::filesystem::path& mission, const std::filesystem::path& run_folder) {
  auto summary = roci::services::process::read_summary(run_folder, roci::mission::load_service_list(mission));
  if (summary.empty()) summary["result"] = "failed";
  std::ifstream expected(run_folder / roci::services::kExpectedFile);
  if (expected) summary["expected"] = nlohmann::json::parse(expected);
  const auto links = roci::services::process::read_link_reports(run_folder);
  if (!links.empty()) summary["links"] = roci::services::process::as_json(links);
  return summary;
}

nlohmann::json fly_once(const Arguments& arguments, std::uint64_t seed,
                        const std::filesystem::path& run_folder, int domain) {
  std::filesystem::create_directories(run_folder);
  FlightOptions options;
  options.run.mission = roci::services::process::mission_folder(arguments.mission);
  options.run.scenario = arguments.scenario;
  options.run.seed = seed;
  options.run.run_folder = run_folder;
  options.domain = domain;
  options.pace = arguments.speed == "max" ? 0 : std::stod(arguments.speed);
  const auto begun = roci::services::clock::wall_now();
  roci::rehearsal::fly(options);
  auto summary = summary_of(options.run.mission, run_folder);
  summary["dds"] = "inproc";
  summary["wall_s"] = std::chrono::duration<double>(roci::services::clock::wall_now() - begun).count();
  return summary;
}

void print(const nlohmann::json& summary) {
  std::cout << "seed " << summary.value("seed", std::uint64_t{0}) << ": " << summary.value("result", "failed")
            << ", " << summary["goals"].dump() << ", replans " << summary.value("replans", 0) << ", "
            << summary.value("sim_s", 0.0) << " s of mission in " << summary.value("wall_s", 0.0) << " s\n";
  if (!summary.contains("expected") || summary["expected"].value("met", false)) return;
  std::cout << "  not as the scenario expects: " << summary["expected"].value("fault", "") << "\n";
}

int rehearse(const Arguments& arguments) {
  const std::filesystem::path base =
      arguments.folder.empty()
          ? std::filesystem::temp_directory_path() / ("rocinante-rehearsal-" + std::to_string(::getpid()))
          : std::filesystem::path(arguments.folder);
  int achieved = 0;
  roci::rehearsal::Statistics statistics;
  nlohmann::json last;
  for (int i = 0; i < arguments.runs; ++i) {
    const std::uint64_t seed = arguments.seed + static_cast<std::uint64_t>(i);
    const auto run_folder =
        arguments.runs == 1 && !arguments.folder.empty() ? base : base / ("seed-" + std::to_string(seed));
    last = fly_once(arguments, seed, run_folder, i + 1);
    achieved += last.value("result", "failed") == "achieved";
    statistics.add(run_folder, last.value("result", "failed"));
    if (!arguments.json) print(last);
    if (arguments.json && arguments.runs > 1) std::cout << last.dump() << "\n";
  }
  if (arguments.folder.empty()) std::filesystem::remove_all(base);
  if (arguments.json && arguments.runs == 1) {
    std::cout << last.dump() << "\n";
  } else if (arguments.json) {
    nlohmann::json total = statistics.json();
    total.update({{"runs", arguments.runs}, {"achieved", achieved}});
    std::cout << total.dump() << "\n";
  } else if (arguments.runs > 1) {
    std::cout << achieved << " of " << arguments.runs << " flights achieved every hard goal\n"
              << statistics.text();
  }
  return achieved == arguments.runs ? kAchieved : kNotAchieved;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Flies a mission with all services in one process, on the simulated clock");
  app.add_option("mission", arguments.mission, "Mission folder, or the name of an installed mission")
      ->required();
  app.add_option("--scenario", arguments.scenario, "Scenario of the mission")->capture_default_str();
  app.add_option("--runs", arguments.runs, "Number of flights, with seeds counted up")
      ->check(roci::services::process::above_zero());
  app.add_option("--seed", arguments.seed, "Seed of the first flight")
      ->check(roci::services::process::from_zero())
      ->capture_default_str();
  app.add_option("--speed", arguments.speed, "Simulated seconds per second, or max")
      ->check(roci::services::process::above_zero() | CLI::IsMember({"max"}));
  app.add_option("--run-folder", arguments.folder,
                 "Where journals and summaries are kept (default: nowhere)");
  app.add_flag("--json", arguments.json,
               "Summaries as JSON, a line each; the last line is the total of several runs");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kAchieved : kBadInput;
  }
  const auto refused = [](const std::exception& error, ExitCode code) {
    std::cerr << "roci-rehearse: " << error.what() << "\n";
    return code;
  };
  try {
    return rehearse(arguments);
  } catch (const roci::rehearsal::NotLoadable& error) {
    return refused(error, kServiceFailed);
  } catch (const std::invalid_argument& error) {
    return refused(error, kBadInput);
  } catch (const std::runtime_error& error) {
    return refused(error, kBadInput);
  } catch (const std::exception& error) {
    return refused(error, kServiceFailed);
  }
}
