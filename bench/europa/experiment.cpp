#include "bench/europa/experiment.hpp"

#include <algorithm>

#include "core/mission/mission_file.hpp"

namespace roci::bench::europa {

namespace model = planner::utility_htn::model;
namespace strategies = planner::utility_htn::strategies;
using planner::utility_htn::adapter::UtilityEngine;

namespace {

const planner::engine::Setup kSetup{"utility_htn", "lander", "", ""};

}  // namespace

Setting read_setting(const std::filesystem::path& file) {
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

Fate Experiment::fate_of(double bias, std::uint64_t seed, const std::string& task,
                         std::uint32_t execution) const {
  if (setting_.only_failure) {
    const auto& [failing, how] = *setting_.only_failure;
    return {.failure = task == failing && execution == 0 ? how : Resolution::none};
  }
  Fate out = fate(TaskWorld{seed, bias, setting_.noise, setting_.failures}, task, execution);
  if (out.failure == Resolution::flexible && setting_.without.contains("retry"))
    out.failure = Resolution::replanning;
  return out;
}

Flown Experiment::flown(Strategy strategy, double bias, std::uint64_t seed,
                        const std::function<double()>& processor_time, temporal::Time until) const {
  planner::utility_htn::cycle::Settings settings;
  if (strategy != Strategy::replanning)
    settings = {.repairs = false, .optimizes = false, .schedules_again = false};
  if (setting_.without.contains("repair")) settings.repairs = false;
  if (setting_.without.contains("optimize")) settings.optimizes = false;
  if (setting_.robust && strategy == Strategy::replanning)
    settings.search = planner::utility_htn::cycle::Search::robust;
  settings.downlinks = setting_.downlinks;
  model::Network network = network_;
  if (setting_.without.contains("learning"))
    for (model::Task& task : network.tasks) task.learns.clear();
  UtilityEngine engine(kSetup, network, settings);
  Flight flight{.network = network,
                .engine = engine,
                .fates = {},
                .strategy = strategy,
                .costs = setting_.costs,
                .until = std::min(until, network.cycle.plan_end),
                .succeeded = {},
                .processor_time = processor_time,
                .look_at = setting_.look_at,
                .look_for = setting_.look_for};
  flight.fates = [&](const std::string& task, std::uint32_t execution) {
    return fate_of(bias, seed, task, execution);
  };
  if (strategy == Strategy::replanning && !setting_.without.contains("discovery"))
    flight.succeeded = [&](const std::string& task) {
      if (const auto found = discovery(seed, task)) engine.learn(found->parameter, found->value);
    };
  return fly(flight);
}

Flown Experiment::without_failures(double bias) const {
  model::Network network = network_;
  auto& battery = network.timelines[network.budget];
  battery.initial = battery.highest = battery.initial / (1 + bias);
  UtilityEngine engine(kSetup, network, {.downlinks = false});
  Flight flight{.network = network, .engine = engine, .fates = {}};
  flight.fates = [](const std::string&, std::uint32_t) { return Fate{}; };
  flight.until = network.cycle.plan_end;
  return fly(flight);
}

Prescience Experiment::prescient(double bias, std::uint64_t seed, double without_j) const {
  Foreknowledge known{.network = network_, .fates = {}, .costs = setting_.costs};
  known.fates = [&](const std::string& task, std::uint32_t execution) {
    return fate_of(bias, seed, task, execution);
  };
  known.discovery = [&](const std::string& task) { return discovery(seed, task); };
  known.budget = network_.timelines[network_.budget].initial - without_j;
  return europa::prescient(known);
}

// The draws are those of tasks that no network has.
std::optional<Discovery> Experiment::discovery(std::uint64_t seed, const std::string& task) const {
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

}  // namespace roci::bench::europa
