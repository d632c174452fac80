// bench_house measures what a house of so many processes costs. For each size the mission's services are
// started with idle ones beside them, twice: at pace 1 before the first goal, for memory, threads and idle
// CPU, and as fast as possible to the end of the mission, for its speed. It prints one JSON object.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "bench/house/house.hpp"
#include "bench/house/idle_service.hpp"
#include "services/process/service_main.hpp"

namespace {

namespace fs = std::filesystem;
namespace house = roci::bench::house;
using nlohmann::json;
using std::chrono::duration;

struct Arguments {
  house::HouseOptions house;
  std::vector<int> sizes{7, 12, 20};
  double settle_s = 2;
  double idle_s = 5;
  bool table = false;
};

double children_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// Mission time goes with the wall's here; the first goals of the scenario must come later than this takes.
void measure_idle(house::HouseOptions options, const Arguments& arguments, const fs::path& folder,
                  json& out) {
  options.pace = 1;
  house::House running(options, folder);
  running.wait_for_clock();
  running.listen(duration<double>(arguments.settle_s));
  const house::ProcessFigures before = running.figures();
  running.listen(duration<double>(arguments.idle_s));
  const house::ProcessFigures after = running.figures();
  out["pss_mb"] = after.pss_mb;
  out["threads"] = after.threads;
  out["idle_cpu_percent"] = 100 * (after.cpu_s - before.cpu_s) / arguments.idle_s;
}

void measure_flight(house::HouseOptions options, const fs::path& folder, json& out) {
  options.pace = 0;
  const double cpu_before = children_cpu_s();
  house::House running(options, folder);
  running.wait_for_clock();
  if (!running.wait_for_end()) throw std::runtime_error("the mission did not end within ten minutes");
  const double flight_s = *running.last_step_s() - *running.first_step_s();
  const house::ClockFigures& clock = running.clock();
  out["start_s"] = *running.first_step_s();
  if (running.first_command_s()) out["first_command_s"] = *running.first_command_s();
  out["sim_s"] = clock.sim_s;
  out["flight_s"] = flight_s;
  out["sim_s_per_s"] = clock.sim_s / flight_s;
  out["cpu_s"] = children_cpu_s() - cpu_before;
  out["micro_steps"] = clock.micro_steps;
  out["samples"] = clock.samples;
  out["samples_per_micro_step"] = static_cast<double>(clock.samples) / static_cast<double>(clock.micro_steps);
}

// Prints the same as Markdown, for docs/house.md.
void print_table(const json& houses) {
  std::cout << "| processes | start | first command | memory (PSS) | threads | idle CPU | mission s per s | "
               "CPU of a flight | "
               "samples per micro-step |\n|---|---|---|---|---|---|---|---|---|\n";
  for (const json& record : houses) {
    std::cout << fmt::format(
        "| {} | {:.2f} s | {:.2f} s | {:.0f} MB | {} | {:.1f} % | {:.0f} | {:.2f} s | {:.2f} |\n",
        record["processes"].get<int>(), record["start_s"].get<double>(), record.value("first_command_s", 0.0),
        record["pss_mb"].get<double>(), record["threads"].get<int>(),
        record["idle_cpu_percent"].get<double>(), record["sim_s_per_s"].get<double>(),
        record["cpu_s"].get<double>(), record["samples_per_micro_step"].get<double>());
  }
}

int bench(const Arguments& arguments) {
  const fs::path folder = fs::temp_directory_path() / ("rocinante-house-" + std::to_string(getpid()));
  json houses = json::array();
  for (const int size : arguments.sizes) {
    house::HouseOptions options = arguments.house;
    options.processes = size;
    json record{{"processes", size}};
    measure_idle(options, arguments, folder / (std::to_string(size) + "-idle"), record);
    measure_flight(options, folder / std::to_string(size), record);
    houses.push_back(record);
  }
  fs::remove_all(folder);
  if (arguments.table) {
    print_table(houses);
    return 0;
  }
  std::cout << json{{"bench", "house"},
                    {"mission", arguments.house.mission.filename().string()},
                    {"scenario", arguments.house.scenario},
                    {"dds", arguments.house.dds},
                    {"seed", arguments.house.seed},
                    {"cores", std::thread::hardware_concurrency()},
                    {"houses", houses}}
                   .dump(2)
            << "\n";
  return 0;
}

// Makes this program one of the idle services; the service's name stands in the place of the program's.
int be_idle(int argc, char** argv) {
  constexpr int kBefore = 2;
  return roci::services::process::service_main(argc - kBefore, argv + kBefore, argv[kBefore],
                                      house::make_idle_service);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 2 && std::string(argv[1]) == "--idle") return be_idle(argc, argv);
  Arguments arguments;
  arguments.house.bin = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "bin";
  CLI::App app("Start time, memory, idle CPU, threads and speed of a mission with so many processes");
  app.add_option("mission", arguments.house.mission, "Mission folder")->required();
  app.add_option("--scenario", arguments.house.scenario, "Scenario of the mission")->capture_default_str();
  app.add_option("--dds", arguments.house.dds, "fastdds, cyclonedds or mixed")->capture_default_str();
  app.add_option("--seed", arguments.house.seed, "Seed of the flight")->capture_default_str();
  app.add_option("--processes", arguments.sizes,
                 "Sizes, this program included, which stands for the launcher")
      ->delimiter(',')
      ->check(CLI::Range(7, 200))
      ->capture_default_str();
  app.add_option("--bin", arguments.house.bin, "Where the services stand")->capture_default_str();
  app.add_option("--settle", arguments.settle_s, "Seconds before idle CPU is counted")->capture_default_str();
  app.add_option("--idle-for", arguments.idle_s, "Seconds for which idle CPU is counted")
      ->capture_default_str();
  app.add_flag("--table", arguments.table, "Print a table in Markdown in the place of JSON");
  CLI11_PARSE(app, argc, argv);
  try {
    return bench(arguments);
  } catch (const std::exception& error) {
    std::cerr << "bench_house: " << error.what() << "\n";
    return 1;
  }
}
