// The experiments of MEXEC, section V.A (R103–R106, R121–R123): four strategies under noise on the energy of tasks,
// whole flights at the level of tasks. One JSON object to standard output.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/europa/experiment.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "planner_svc/utility_htn/strategies/equations.hpp"

namespace roci::bench::europa {
namespace {

using nlohmann::json;
namespace model = planner::utility_htn::model;
namespace strategies = planner::utility_htn::strategies;

// What is flown and told.
struct Wanted {
  std::uint64_t first = 1;
  std::vector<std::string> strategies;  // none: all
  bool prescient = true;
  bool executions = false;
};

constexpr struct {
  Strategy strategy;
  const char* name;
} kStrategies[] = {{Strategy::as_planned, "static"},
                   {Strategy::ground, "ground"},
                   {Strategy::flexible_execution, "fe"},
                   {Strategy::replanning, "replan"}};

// Reads "TASK=KIND".
std::pair<std::string, Resolution> failure_of(const std::string& text) {
  constexpr std::pair<const char*, Resolution> kKinds[] = {{"none", Resolution::none},
                                                           {"flexible", Resolution::flexible},
                                                           {"replanning", Resolution::replanning},
                                                           {"ground", Resolution::ground}};
  const std::size_t mark = text.find('=');
  const std::string kind = mark == std::string::npos ? "" : text.substr(mark + 1);
  for (const auto& [name, resolution] : kKinds)
    if (kind == name) return {text.substr(0, mark), resolution};
  throw std::invalid_argument(
      "--failure is TASK=none, TASK=flexible, TASK=replanning or TASK=ground, and not " + text);
}

json energy_of(const Energy& energy) {
  return {{"completed", energy.completed},
          {"recovering", energy.recovering},
          {"broken_off", energy.broken_off},
          {"fixed", energy.fixed}};
}

json json_of(const Seen& seen) {
  json out{{"now_s", temporal::to_seconds(seen.now)}};
  for (const auto& corner : seen.projection)
    out["projection"].push_back({temporal::to_seconds(corner.time), corner.value});
  for (const auto& [task, intervals] : seen.valid) {
    out["valid"][task] = json::array();
    for (const auto& one : intervals)
      out["valid"][task].push_back({temporal::to_seconds(one.earliest), temporal::to_seconds(one.latest)});
  }
  return out;
}

json summary_of(const Flown& flown, bool executions) {
  json course = json::array();
  for (const auto& point : flown.course) course.push_back({point.spent, point.utility[0], point.chain});
  json out{{"utility", flown.utility[0]},
           {"spent", flown.spent},
           {"ended_by", flown.ended_by},
           {"tasks", flown.tasks},
           {"failures", flown.failures},
           {"retried", flown.retried},
           {"replanned", flown.replanned},
           {"by_ground", flown.by_ground},
           {"versions", flown.versions},
           {"faults", flown.faults},
           {"end_s", temporal::to_seconds(flown.end)},
           {"energy", energy_of(flown.energy)},
           {"course", course}};
  if (flown.seen) out["seen"] = json_of(*flown.seen);
  if (!executions) return out;
  out["decisions"] = flown.decisions;
  for (const Execution& one : flown.executions)
    out["executions"].push_back({{"task", one.task},
                                 {"chain", one.chain},
                                 {"block", one.block},
                                 {"start_s", temporal::to_seconds(one.start)},
                                 {"end_s", temporal::to_seconds(one.end)},
                                 {"spent", one.spent},
                                 {"result", one.result}});
  return out;
}

json summary_of(const Prescience& known) {
  return {{"utility", known.utility},   {"discovered", known.discovered}, {"energy", known.energy},
          {"recovery", known.recovery}, {"fixed", known.fixed},           {"tasks", known.tasks},
          {"chains", known.chains},     {"proven", known.proven}};
}

// The figures of the equations: u_avg and c_avg over all that prescient plans do,
// and as many tasks as b pays for (section V.A).
json expected(const model::Network& network, const Setting& setting,
              const std::vector<Prescience>& prescients) {
  double utility = 0, cost = 0, tasks = 0;
  for (const Prescience& one : prescients) {
    utility += one.utility - one.discovered;
    cost += one.energy + one.fixed;
    tasks += one.tasks;
  }
  const double budget = network.timelines[network.budget].initial;
  const strategies::PlanFigures plan{budget, budget * tasks / cost, utility / cost, cost / tasks};
  const auto& odds = setting.failures;
  const strategies::RecoveryCosts costs{setting.costs.ground_j, setting.costs.replanning_j};
  const strategies::Discoveries found{9 * setting.discovery_share, setting.discovery_utility};
  const auto utilities = [&](const strategies::PlanFigures& until, double share) {
    const strategies::Discoveries so_far{share * found.count, found.utility_each};
    return json{{"spent", until.budget},
                {"static", strategies::static_utility(until, odds)},
                {"ground", strategies::ground_utility(until, odds, costs)},
                {"fe", strategies::flexible_utility(until, odds, costs)},
                {"replan", strategies::replanning_utility(until, odds, costs, so_far)}};
  };
  json out = utilities(plan, 1);
  out["u_avg_per_mj"] = plan.utility_per_cost * 1e6;
  out["tasks"] = plan.tasks;
  out["curve"] = json::array();
  constexpr int kPoints = 50;
  for (int i = 0; i <= kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    out["curve"].push_back(utilities(strategies::until_spent(plan, share * plan.budget), share));
  }
  return out;
}

// What the same planner would bring home without the energy that the flight put into chains which it did not complete,
// and without that which it did not spend.
json ladder(const Experiment& experiment, const model::Network& network, const Flown& flown, double bias,
            std::uint64_t seed) {
  const double unspent = network.timelines[network.budget].initial - flown.spent;
  const double broken = flown.energy.broken_off;
  return {experiment.prescient(bias, seed, broken).utility,
          experiment.prescient(bias, seed, broken + unspent).utility};
}

json variant(const Experiment& experiment, const model::Network& network, const Setting& setting,
             const Wanted& wanted, double bias) {
  const auto seeds = [&](auto each) {
    for (int run = 0; run < setting.runs; ++run) each(wanted.first + static_cast<std::uint64_t>(run));
  };
  json out{{"bias", bias}, {"without_failures", summary_of(experiment.without_failures(bias), false)}};
  std::vector<Prescience> prescients;
  if (wanted.prescient) {
    seeds([&](std::uint64_t seed) { prescients.push_back(experiment.prescient(bias, seed)); });
    for (const Prescience& one : prescients) out["prescient"].push_back(summary_of(one));
    out["expected"] = expected(network, setting, prescients);
  }
  for (const auto& [strategy, name] : kStrategies) {
    if (!wanted.strategies.empty() && std::ranges::find(wanted.strategies, name) == wanted.strategies.end())
      continue;
    json flights = json::array();
    seeds([&](std::uint64_t seed) {
      std::fprintf(stderr, "\r%+.0f %% %-7s seed %d ", 100 * bias, name, static_cast<int>(seed));
      const Flown flown = experiment.flown(strategy, bias, seed);
      flights.push_back(summary_of(flown, wanted.executions));
      if (wanted.prescient && strategy == Strategy::replanning)
        flights.back()["ladder"] = ladder(experiment, network, flown, bias, seed);
    });
    out[name] = flights;
  }
  return out;
}

// The command line. What is not given stays as the settings' file says.
struct CommandLine {
  std::string network_file = "missions/europa/network.yaml";
  std::string settings_file = "bench/europa/experiments.yaml";
  Wanted wanted;
  int runs = 0;
  std::vector<double> biases;
  std::optional<double> ground_j, replanning_j, discovery_share, discovery_utility;
  std::vector<std::string> without;
  bool robust = false, downlinks = false, no_prescient = false;
  std::string failure;
  std::optional<double> look_days;
  std::vector<std::string> look_for;
};

void add_what_is_flown(CLI::App& app, CommandLine& line) {
  app.add_option("--network", line.network_file, "the network that is flown")->capture_default_str();
  app.add_option("--settings", line.settings_file, "probabilities and costs")->capture_default_str();
  app.add_option("--runs", line.runs, "flights of each strategy and bias (default: those of the settings)");
  app.add_option("--seed", line.wanted.first, "of the first flight")->capture_default_str();
  app.add_option("--bias", line.biases,
                 "share by which tasks take more than the network says (default: those of the settings)");
  app.add_option("--strategy", line.wanted.strategies, "those that are flown (default: all)")
      ->check(CLI::IsMember({"static", "ground", "fe", "replan"}));
  app.add_option("--failure", line.failure,
                 "TASK=none|flexible|replanning|ground: only the first execution of this task fails, and "
                 "energies are the model's");
}

void add_costs_and_discoveries(CLI::App& app, CommandLine& line) {
  app.add_option("--ground-j", line.ground_j, "c_g, instead of that of the settings")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--replanning-j", line.replanning_j, "c_r")->check(CLI::NonNegativeNumber);
  app.add_option("--discovery-share", line.discovery_share, "share of analyses that find something")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--discovery-utility", line.discovery_utility, "u_d")->check(CLI::NonNegativeNumber);
}

void add_what_the_planner_does(CLI::App& app, CommandLine& line) {
  app.add_option("--without", line.without,
                 "what replanning does without: retry (what it resolves is planned anew), repair, optimize, "
                 "learning, "
                 "discovery")
      ->check(CLI::IsMember({"retry", "repair", "optimize", "learning", "discovery"}));
  app.add_flag("--robust", line.robust,
               "replanning judges plans by the worst of more, less and predicted energy");
  app.add_flag("--downlinks", line.downlinks, "the Downlink Manager is asked");
}

void add_what_is_told(CLI::App& app, CommandLine& line) {
  app.add_flag("--no-prescient", line.no_prescient,
               "leaves out what a planner brings home that knows everything");
  app.add_flag("--executions", line.wanted.executions, "tells every attempt of every task");
  app.add_option("--look-days", line.look_days, "tells what is projected then")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--look-for", line.look_for, "and when these tasks could start");
}

Setting setting_of(const CommandLine& line) {
  Setting setting = read_setting(line.settings_file);
  if (line.runs > 0) setting.runs = line.runs;
  if (!line.biases.empty()) setting.biases = line.biases;
  setting.costs.ground_j = line.ground_j.value_or(setting.costs.ground_j);
  setting.costs.replanning_j = line.replanning_j.value_or(setting.costs.replanning_j);
  setting.discovery_share = line.discovery_share.value_or(setting.discovery_share);
  setting.discovery_utility = line.discovery_utility.value_or(setting.discovery_utility);
  setting.without.insert(line.without.begin(), line.without.end());
  setting.robust = line.robust;
  setting.downlinks = line.downlinks;
  if (line.look_days) setting.look_at = temporal::seconds(86400 * *line.look_days);
  setting.look_for = line.look_for;
  if (!line.failure.empty()) setting.only_failure = failure_of(line.failure);
  return setting;
}

json fly_all(const CommandLine& line) {
  const auto network = planner::utility_htn::reading::load_network(std::filesystem::path(line.network_file));
  const Setting setting = setting_of(line);
  Wanted wanted = line.wanted;
  wanted.prescient = !line.no_prescient;
  const Experiment experiment(network, setting);
  json out{{"network", line.network_file},
           {"runs", setting.runs},
           {"first_seed", wanted.first},
           {"budget", network.timelines[network.budget].initial},
           {"variants", json::array()}};
  for (const double bias : setting.biases)
    out["variants"].push_back(variant(experiment, network, setting, wanted, bias));
  return out;
}

}  // namespace
}  // namespace roci::bench::europa

int main(int argc, char** argv) {
  using namespace roci::bench::europa;
  CLI::App app{"Flies the experiments of MEXEC, section V.A"};
  CommandLine line;
  add_what_is_flown(app, line);
  add_costs_and_discoveries(app, line);
  add_what_the_planner_does(app, line);
  add_what_is_told(app, line);
  CLI11_PARSE(app, argc, argv);
  try {
    const json out = fly_all(line);
    std::fprintf(stderr, "\n");
    std::cout << out.dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "bench_europa: " << error.what() << '\n';
    return 1;
  }
}
