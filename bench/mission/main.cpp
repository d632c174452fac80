// bench_mission flies a mission with the launcher, in real processes, and reports what an operator waits for:
// seconds from the start of the launcher to the first command on the topic, seconds of the whole run; and
// what the planner cost: calls, the slowest, its peak memory. It prints one JSON object for each run.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/launch/child.hpp"
#include "services/launch/process_plan.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/transport/plug_ins.hpp"

namespace {

using namespace std::chrono_literals;
using namespace roci::services;
namespace fs = std::filesystem;

struct Arguments {
  std::string mission;
  std::string scenario = "nominal";
  std::string dds = "fastdds";
  std::string speed = "max";
  int runs = 5;
};

nlohmann::json fly(const Arguments& arguments, int seed, const fs::path& folder) {
  const process::DomainClaim domain;
  transport::TransportOptions transport;
  transport.domain = domain.id();
  transport.participant = "bench";
  node::NodeOptions options;
  options.name = "bench";
  options.clock = clock::ClockMode::observer;
  options.vendor = roci::services::launch::console_vendor(arguments.dds);
  Node node(options, transport::open_transport(options.vendor, transport));
  std::optional<clock::WallTime> first_command;
  subscribe(node, topics::command, [&first_command](const roci::v1::Command&) {
    if (!first_command) first_command = clock::wall_now();
  });

  const auto program = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "bin" / "roci-launch";
  const fs::path run_folder = folder / ("seed-" + std::to_string(seed));
  const auto begun = clock::wall_now();
  roci::services::launch::Child launcher(
      program,
      {"roci-launch", arguments.mission, "--scenario", arguments.scenario, "--dds", arguments.dds, "--speed",
       arguments.speed, "--seed", std::to_string(seed), "--domain", std::to_string(domain.id()), "--headless",
       "--run-folder", run_folder.string()},
      folder / "launcher.log");
  std::optional<roci::services::launch::Ending> ending;
  while (!(ending = launcher.ending())) node.spin_once(2ms);
  const std::chrono::duration<double> wall_s = clock::wall_now() - begun;

  std::ifstream in(run_folder / "summary.json");
  const auto summary = nlohmann::json::parse(in, nullptr, false);
  nlohmann::json out{
      {"bench", "mission"},
      {"scenario", arguments.scenario},
      {"dds", arguments.dds},
      {"seed", seed},
      {"exit_code", ending->code},
      {"wall_s", wall_s.count()},
      {"planner", summary.is_object() ? summary.value("planner", nlohmann::json{}) : nlohmann::json{}}};
  if (first_command) out["first_command_s"] = std::chrono::duration<double>(*first_command - begun).count();
  return out;
}

int bench(const Arguments& arguments) {
  const fs::path folder = fs::temp_directory_path() / ("rocinante-bench-" + std::to_string(getpid()));
  fs::create_directories(folder);
  bool all_achieved = true;
  for (int seed = 1; seed <= arguments.runs; ++seed) {
    const auto record = fly(arguments, seed, folder);
    std::cout << record.dump() << std::endl;
    all_achieved = all_achieved && record["exit_code"] == 0;
  }
  fs::remove_all(folder);
  return all_achieved ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("What an operator waits for: start to first command, a whole run, and the planner's cost");
  app.add_option("mission", arguments.mission, "Mission folder")->required();
  app.add_option("--scenario", arguments.scenario, "Scenario of the mission")->capture_default_str();
  app.add_option("--dds", arguments.dds, "fastdds, cyclonedds or mixed")->capture_default_str();
  app.add_option("--speed", arguments.speed, "As roci-launch takes it")->capture_default_str();
  app.add_option("--runs", arguments.runs, "Runs, with seeds 1, 2, …")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    return bench(arguments);
  } catch (const std::exception& error) {
    std::cerr << "bench_mission: " << error.what() << "\n";
    return 1;
  }
}
