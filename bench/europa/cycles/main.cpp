// What planning costs on the Europa lander: a whole flight in process, the processor time of each cycle and of each
// event of the executive, and the memory that it took (R79, R82, R100). One JSON object to standard output.
#include <sys/resource.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/europa/cycles/sized_network.hpp"
#include "bench/europa/experiment.hpp"

namespace roci::bench::europa {
namespace {

using nlohmann::json;

double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

json spread(std::vector<double> seconds) {
  if (seconds.empty()) return {{"count", 0}};
  std::ranges::sort(seconds);
  const auto at = [&](double share) {
    return 1e3 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
  double sum = 0;
  for (const double one : seconds) sum += one;
  return {{"count", seconds.size()},
          {"p50_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"max_ms", at(1)},
          {"sum_ms", 1e3 * sum}};
}

json told(const planner::utility_htn::model::Network& network, const Flown& flown, double before_mib) {
  std::vector<double> cycles, quiet, searching, listening;
  std::uint64_t explored = 0, most = 0;
  for (const EngineStep& step : flown.steps) {
    if (!step.cycle) listening.push_back(step.seconds);
    if (!step.cycle) continue;
    cycles.push_back(step.seconds);
    if (step.explored == 0 && !step.sent) quiet.push_back(step.seconds);
    if (step.explored > 0) searching.push_back(step.seconds);
    explored += step.explored;
    most = std::max(most, step.explored);
  }
  const double worst = cycles.empty() ? 0 : *std::ranges::max_element(cycles);
  return {{"cycles", spread(cycles)},
          {"nothing_changed", spread(quiet)},
          {"searching", spread(searching)},
          {"between_cycles", spread(listening)},
          {"executive", spread(flown.events)},
          {"explored", explored},
          {"explored_at_most", most},
          {"worst_times_1500_s", 1500 * worst},
          {"interval_s", temporal::to_seconds(network.cycle.process_interval)},
          {"peak_mib", peak_mib()},
          {"before_mib", before_mib},
          {"utility", to_text(flown.utility)},
          {"ended_by", flown.ended_by},
          {"end_s", temporal::to_seconds(flown.end)},
          {"versions", flown.versions},
          {"faults", flown.faults.size()},
          {"decisions", flown.decisions}};
}

}  // namespace
}  // namespace roci::bench::europa

int main(int argc, char** argv) {
  using namespace roci::bench::europa;
  CLI::App app{"Measures the cycles of Reference Surface Mission 1, and of larger ones"};
  std::string mission = "missions/europa", settings = "bench/europa/experiments.yaml";
  std::size_t sites = 3, targets = 3;
  std::uint64_t seed = 1;
  double days = 0;
  app.add_option("--mission", mission, "folder of network-rsm1.yaml")->capture_default_str();
  app.add_option("--settings", settings, "odds and costs of failures")->capture_default_str();
  app.add_option("--sites", sites)->capture_default_str()->check(CLI::Range(1, 100));
  app.add_option("--targets", targets, "of each site")->capture_default_str()->check(CLI::Range(1, 20));
  app.add_option("--seed", seed)->capture_default_str();
  app.add_option("--days", days, "ends the flight then (default: with the mission)");
  CLI11_PARSE(app, argc, argv);
  try {
    auto network = sized_network(mission, sites, targets);
    Setting setting = read_setting(settings);
    setting.without.insert("discovery");
    setting.downlinks = true;
    const double before = peak_mib();
    const Experiment experiment(network, setting);
    const auto until = days > 0 ? roci::temporal::seconds(86400 * days) : roci::temporal::no_bound;
    const Flown flown = experiment.flown(Strategy::replanning, 0, seed, processor_time, until);
    json out = told(network, flown, before);
    out["sites"] = sites;
    out["targets"] = targets;
    out["seed"] = seed;
    std::cout << out.dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "bench_europa_cycles: " << error.what() << '\n';
    return 1;
  }
}
