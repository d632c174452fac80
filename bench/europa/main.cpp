// The experiments of MEXEC, section V.A (R103–R106, R121–R123): four strategies under noise on the energy of tasks, whole flights at the level
// of tasks. One JSON object to standard output.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "bench/europa/task_flight.hpp"
#include "bench/europa/task_world.hpp"
#include "core/mission/mission_file.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "planner_svc/utility_htn/strategies/equations.hpp"

namespace roci::bench::europa {
namespace {

using nlohmann::json;
namespace model = planner::utility_htn::model;
namespace strategies = planner::utility_htn::strategies;

struct Setting {
  double noise = 0;
  strategies::FailureProbabilities failures;
  int runs = 50;
  std::vector<double> biases;
  Costs costs;
  double discovery_share = 0;
  double discovery_utility = 0;
  std::set<std::string> without;  // "retry", "repair": what replanning has to do without
};

Setting read(const std::filesystem::path& file) {
  const auto root = mission::Entry::load(file);
  const auto number = [&](const char* key) { return root.at(key).at("value").number(); };
  Setting out;
  out.runs = static_cast<int>(number("runs"));
  out.noise = number("noise");
  out.failures =
      strategies::split(number("fail"), number("flexible_share"), number("replanning_share_of_rest"));
  for (const auto& bias : root.at("biases").at("value").items()) out.biases.push_back(bias.number());
  out.costs = {number("replanning_j"), number("ground_j"), temporal::seconds(number("ground_wait_s"))};
  out.discovery_share = number("discovery_share");
  out.discovery_utility = number("discovery_utility");
  return out;
}

constexpr struct {
  Strategy strategy;
  const char* name;
} kStrategies[] = {{Strategy::as_planned, "static"},
                   {Strategy::ground, "ground"},
                   {Strategy::flexible_execution, "fe"},
                   {Strategy::replanning, "replan"}};

class Experiment {
 public:
  Experiment(const model::Network& network, const Setting& setting) : network_(network), setting_(setting) {}

  Flown flown(Strategy strategy, double bias, std::uint64_t seed) const {
    planner::utility_htn::cycle::Settings settings;
    if (strategy != Strategy::replanning)
      settings = {.repairs = false, .optimizes = false, .schedules_again = false};
    if (setting_.without.contains("repair")) settings.repairs = false;
    settings.downlinks = false;
    planner::utility_htn::adapter::UtilityEngine engine({"utility_htn", "lander", "", ""}, network_,
                                                        settings);
    const TaskWorld world{seed, bias, setting_.noise, setting_.failures};
    Flight flight{
        .network = network_, .engine = engine, .fates = {}, .strategy = strategy, .costs = setting_.costs};
    flight.fates = [&](const std::string& task, std::uint32_t execution) {
      Fate out = fate(world, task, execution);
      if (out.failure == Resolution::flexible && setting_.without.contains("retry"))
        out.failure = Resolution::replanning;
      return out;
    };
    flight.until = network_.cycle.plan_end;
    if (strategy == Strategy::replanning)
      flight.succeeded = [&](const std::string& task) { discover(engine, seed, task); };
    return fly(flight);
  }

  // A flight in which everything goes as the network has it, on a battery that bears the bias.
  Flown prescient(double bias) const {
    model::Network network = network_;
    auto& battery = network.timelines[network.budget];
    battery.initial = battery.highest = battery.initial / (1 + bias);
    planner::utility_htn::adapter::UtilityEngine engine({"utility_htn", "lander", "", ""}, network,
                                                        {.downlinks = false});
    Flight flight{.network = network, .engine = engine, .fates = {}, .strategy = Strategy::replanning};
    flight.fates = [](const std::string&, std::uint32_t) { return Fate{}; };
    flight.until = network.cycle.plan_end;
    return fly(flight);
  }

  // All that the seed's analyses can show. No planner, however much it knows beforehand, brings home more than the worth of the whole
  // network and this.
  double discoverable(std::uint64_t seed) const {
    std::map<std::string, double> found;  // an analysis for each form of its data shows the same
    for (const auto& task : network_.tasks)
      if (const auto here = discovery(seed, task.id)) found[here->parameter] = here->more;
    double sum = 0;
    for (const auto& [parameter, more] : found) sum += more;
    return sum;
  }

 private:
  struct Discovery {
    std::string parameter;
    double value = 0;
    double more = 0;  // than the prior
  };

  // An analysis may show that another target of the same site is worth more than it looked. The draws are those of tasks that no
  // network has.
  std::optional<Discovery> discovery(std::uint64_t seed, const std::string& task) const {
    if (!task.starts_with("science_analyze")) return {};
    const std::string target = task.substr(task.size() - 3);  // "0_2"
    const TaskWorld world{seed, 0, 0, {setting_.discovery_share, setting_.discovery_share, 0, 0}};
    if (fate(world, "discovery/" + target, 0).failure == Resolution::none) return {};
    const auto site = "worth_" + target.substr(0, 2);
    for (int i = 1; i < 3; ++i) {
      const std::string other = site + std::to_string((target.back() - '0' + i) % 3);
      const auto parameter = std::ranges::find(network_.parameters, other, &model::Parameter::name);
      if (parameter == network_.parameters.end()) continue;
      const double value = std::min(parameter->highest, parameter->prior + setting_.discovery_utility);
      return Discovery{other, value, value - parameter->prior};
    }
    return {};
  }

  // Only an engine that plans anew hears of it.
  void discover(planner::utility_htn::adapter::UtilityEngine& engine, std::uint64_t seed,
                const std::string& task) const {
    if (const auto found = discovery(seed, task)) engine.learn(found->parameter, found->value);
  }

  const model::Network& network_;
  const Setting& setting_;
};

json summary_of(const Flown& flown) {
  json course = json::array();
  for (const auto& point : flown.course) course.push_back({point.spent, point.utility[0], point.chain});
  return {{"utility", flown.utility[0]},
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
          {"course", course}};
}

json expected(const model::Network& network, const Setting& setting, const Flown& prescient, double bias) {
  const auto& battery = network.timelines[network.budget];
  const double spent = prescient.spent * (1 + bias);
  const double tasks = prescient.tasks;
  const strategies::PlanFigures plan{battery.initial, tasks, prescient.utility[0] / spent, spent / tasks};
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
  out["tasks"] = tasks;
  out["curve"] = json::array();
  constexpr int kPoints = 50;
  for (int i = 0; i <= kPoints; ++i) {
    const double share = static_cast<double>(i) / kPoints;
    out["curve"].push_back(utilities(strategies::until_spent(plan, share * plan.budget), share));
  }
  return out;
}

}  // namespace
}  // namespace roci::bench::europa

int main(int argc, char** argv) {
  using namespace roci::bench::europa;
  CLI::App app{"Flies the experiments of MEXEC, section V.A"};
  std::string network_file = "missions/europa/network.yaml", settings_file = "bench/europa/experiments.yaml";
  int runs = 0;
  std::uint64_t first = 1;
  std::vector<double> biases;
  std::vector<std::string> strategies, without;
  std::optional<double> ground_j, replanning_j, discovery_share, discovery_utility;
  app.add_option("--network", network_file, "the network that is flown")->capture_default_str();
  app.add_option("--settings", settings_file, "probabilities and costs")->capture_default_str();
  app.add_option("--runs", runs, "flights of each strategy and bias (default: those of the settings)");
  app.add_option("--seed", first, "of the first flight")->capture_default_str();
  app.add_option("--bias", biases,
                 "share by which tasks take more than the network says (default: those of the settings)");
  app.add_option("--strategy", strategies, "those that are flown (default: all)")
      ->check(CLI::IsMember({"static", "ground", "fe", "replan"}));
  app.add_option("--ground-j", ground_j, "c_g, instead of that of the settings")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--replanning-j", replanning_j, "c_r")->check(CLI::NonNegativeNumber);
  app.add_option("--discovery-share", discovery_share, "share of analyses that find something")
      ->check(CLI::Range(0.0, 1.0));
  app.add_option("--discovery-utility", discovery_utility, "u_d")->check(CLI::NonNegativeNumber);
  app.add_option("--without", without,
                 "what replanning does without: retry (what it resolves is planned anew), repair, discovery")
      ->check(CLI::IsMember({"retry", "repair", "discovery"}));
  CLI11_PARSE(app, argc, argv);
  try {
    const auto network =
        roci::planner::utility_htn::reading::load_network(std::filesystem::path(network_file));
    Setting setting = read(settings_file);
    if (runs > 0) setting.runs = runs;
    if (!biases.empty()) setting.biases = biases;
    setting.costs.ground_j = ground_j.value_or(setting.costs.ground_j);
    setting.costs.replanning_j = replanning_j.value_or(setting.costs.replanning_j);
    setting.discovery_share = discovery_share.value_or(setting.discovery_share);
    setting.discovery_utility = discovery_utility.value_or(setting.discovery_utility);
    setting.without.insert(without.begin(), without.end());
    if (setting.without.contains("discovery")) setting.discovery_share = 0;
    const Experiment experiment(network, setting);
    json out{{"network", network_file},
             {"runs", setting.runs},
             {"first_seed", first},
             {"budget", network.timelines[network.budget].initial},
             {"variants", json::array()}};
    for (const double bias : setting.biases) {
      const Flown prescient = experiment.prescient(bias);
      json variant{{"bias", bias},
                   {"prescient", summary_of(prescient)},
                   {"expected", expected(network, setting, prescient, bias)}};
      for (const auto& [strategy, name] : kStrategies) {
        if (!strategies.empty() && std::ranges::find(strategies, name) == strategies.end()) continue;
        json flights = json::array();
        for (int run = 0; run < setting.runs; ++run) {
          std::fprintf(stderr, "\r%+.0f %% %-7s %d of %d ", 100 * bias, name, run + 1, setting.runs);
          const std::uint64_t seed = first + static_cast<std::uint64_t>(run);
          flights.push_back(summary_of(experiment.flown(strategy, bias, seed)));
          flights.back()["discoverable"] = experiment.discoverable(seed);
        }
        variant[name] = flights;
      }
      out["variants"].push_back(variant);
    }
    std::fprintf(stderr, "\n");
    std::cout << out.dump(1) << '\n';
  } catch (const std::exception& error) {
    std::cerr << "bench_europa: " << error.what() << '\n';
    return 1;
  }
}
