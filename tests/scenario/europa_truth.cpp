#include "tests/scenario/europa_truth.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::scenario {
namespace {

using planner::utility_htn::model::Amount;
using planner::utility_htn::model::Network;
using planner::utility_htn::model::Parameter;
using planner::utility_htn::model::Product;
using planner::utility_htn::model::Site;
using planner::utility_htn::model::Target;
using planner::utility_htn::model::Task;
using planner::utility_htn::model::Tier;

class Mean {
 public:
  void add(double value) {
    sum_ += value;
    ++count_;
  }
  double value_or(double other) const { return count_ > 0 ? sum_ / count_ : other; }

 private:
  double sum_ = 0;
  int count_ = 0;
};

double seconds(long long us) { return static_cast<double>(us) / 1e6; }

// What each task took, by its id; energy of its commands alone.
struct Taken {
  std::map<std::string, Mean> duration_s, power_w;
  double energy_j = 0;  // of all commands together
};

Taken taken_in(const HeardFlight& flight) {
  Taken out;
  std::map<std::string, double> energy;
  for (const v1::CommandAck& answer : flight.answers) {
    if (!std::isfinite(answer.outcome().energy_j())) continue;
    energy[answer.activity()] += answer.outcome().energy_j();
    out.energy_j += answer.outcome().energy_j();
  }
  for (const v1::StepStatus& step : flight.steps) {
    if (step.state() != v1::ACTIVITY_SUCCEEDED || step.started_us() < 0) continue;
    const double took = seconds(step.ended_us() - step.started_us());
    out.duration_s[step.name()].add(took);
    if (energy.contains(step.activity()) && took > 0)
      out.power_w[step.name()].add(energy[step.activity()] / took);
  }
  return out;
}

std::uint32_t index_of(const Network& network, const std::string& parameter) {
  const auto found = std::ranges::find(network.parameters, parameter, &Parameter::name);
  return static_cast<std::uint32_t>(found - network.parameters.begin());
}

void set_prior(Network& network, const Amount& amount, const Mean& truth) {
  if (!amount.parameter || amount.constant != 0 || std::abs(amount.factor) != 1) return;
  auto& parameter = network.parameters[*amount.parameter];
  parameter.prior = std::clamp(truth.value_or(parameter.prior), parameter.lowest, parameter.highest);
}

// Several tasks may stand on one parameter, as all uplinks do: then it is their mean.
void tell_of_tasks(Network& network, const Taken& taken) {
  std::map<std::uint32_t, Mean> durations, powers;
  const auto add = [](std::map<std::uint32_t, Mean>& to, const Amount& amount,
                      const std::map<std::string, Mean>& from, const std::string& task) {
    const auto known = from.find(task);
    if (amount.parameter && known != from.end()) to[*amount.parameter].add(known->second.value_or(0));
  };
  const auto draw = [&](const Task& task) -> const Amount* {
    for (const auto& impact : task.impacts)
      if (impact.timeline == network.budget && impact.kind == temporal::ImpactKind::rate)
        return &impact.amount;
    return nullptr;
  };
  std::set<std::uint32_t> unmeasured;  // powers of tasks without a command as well
  for (const Task& task : network.tasks)
    if (const Amount* power = draw(task); task.commands.empty() && power != nullptr && power->parameter)
      unmeasured.insert(*power->parameter);
  for (const Task& task : network.tasks) {
    if (task.commands.empty()) continue;
    if (!task.downlinks) add(durations, task.duration, taken.duration_s, task.id);
    if (const Amount* power = draw(task)) add(powers, *power, taken.power_w, task.id);
  }
  for (const Task& task : network.tasks) {
    if (task.commands.empty()) continue;
    if (const auto& of = task.duration.parameter; of && durations.contains(*of))
      set_prior(network, task.duration, durations.at(*of));
    if (const Amount* power = draw(task); power != nullptr && power->parameter &&
                                          powers.contains(*power->parameter) &&
                                          !unmeasured.contains(*power->parameter))
      set_prior(network, *power, powers.at(*power->parameter));
  }
}

// What the battery gave beside commands and what the seismometer took, over the whole flight.
void tell_of_hotel_load(Network& network, const HeardFlight& flight, const Taken& taken) {
  std::vector<const v1::Observation*> levels;
  for (const v1::Observation& one : flight.observations)
    if (one.timeline() == network.timelines[network.budget].name) levels.push_back(&one);
  if (levels.size() < 2) return;
  double recorded_s = 0;
  for (const v1::StepStatus& step : flight.steps)
    if (step.name() == "seismometer_on" && step.state() == v1::ACTIVITY_SUCCEEDED)
      recorded_s += seconds(step.ended_us() - step.started_us());
  const double lasted = seconds(levels.back()->sampled_us() - levels.front()->sampled_us());
  const double spent = levels.front()->observed().number() - levels.back()->observed().number();
  const double seismometer_j = network.parameters[index_of(network, "seismometer_w")].prior * recorded_s;
  Mean hotel_w;
  hotel_w.add((spent - taken.energy_j - seismometer_j) / lasted);
  set_prior(network, {0, index_of(network, "hotel_w")}, hotel_w);
}

// "raw_1_0" is of the kind "raw".
std::string kind_of(const std::string& product) {
  const auto end = product.find_last_not_of("0123456789_");
  return product.substr(0, end + 1);
}

void tell_of_data(Network& network, const HeardFlight& flight) {
  std::map<std::string, Mean> by_name, by_kind;
  std::map<Tier, Mean> share;
  const auto values = priors(network);
  std::map<std::string, double> foreseen;
  std::map<std::string, Tier> tier;
  for (const Task& task : network.tasks)
    for (const Product& product : task.products) {
      foreseen[product.name] = evaluate(product.bytes, values);
      tier[product.name] = product.tier;
    }
  for (const v1::DataProduct& one : flight.products) {
    if (one.fate() != v1::PRODUCT_STORED) continue;
    const auto bytes = static_cast<double>(one.bytes());
    by_name[one.product_kind()].add(bytes);
    by_kind[kind_of(one.product_kind())].add(bytes);
    if (foreseen.contains(one.product_kind()))
      share[tier[one.product_kind()]].add(bytes / foreseen[one.product_kind()]);
  }
  for (Task& task : network.tasks)
    for (Product& product : task.products) {
      const double by_tier = foreseen[product.name] * share[product.tier].value_or(1);
      product.bytes = {
          std::round(by_name[product.name].value_or(by_kind[kind_of(product.name)].value_or(by_tier)))};
    }
}

// Within one downlink the next product follows at once, so what lies between two ends is its transmission.
void tell_of_rate(Network& network, const HeardFlight& flight, double since_s) {
  std::map<std::string, double> bytes;
  for (const v1::DataProduct& one : flight.products) bytes[one.id()] = static_cast<double>(one.bytes());
  Mean rate;
  const nlohmann::json* before = nullptr;
  for (const nlohmann::json& deed : flight.deeds) {
    if (deed["kind"] != "downlink" || deed["time_us"].get<double>() / 1e6 < since_s) continue;
    if (before != nullptr && (*before)["activity"] == deed["activity"])
      rate.add(bytes[deed["object"]] * 1e6 /
               (deed["time_us"].get<double>() - (*before)["time_us"].get<double>()));
    before = &deed;
  }
  set_prior(network, {0, index_of(network, "rate_bytes_per_s")}, rate);
}

// The search knows a downlink by its length in the network: as long as the data take that its chain brings, residual
// ones aside, and never shorter than it was foreseen.
void tell_of_lengths(Network& network) {
  const auto values = priors(network);
  const double rate = values[index_of(network, "rate_bytes_per_s")];
  for (const auto& chain : planner::utility_htn::flattening::flatten_all(network).chains) {
    double bytes = 0;
    for (const auto& link : chain.links) {
      const Task& task = network.tasks[link.task];
      for (const Product& product : task.products)
        if (product.tier != Tier::residual) bytes += evaluate(product.bytes, values);
      if (!task.downlinks || !task.duration.parameter) continue;
      Parameter& length = network.parameters[*task.duration.parameter];
      length.prior = std::clamp(std::ceil(bytes / rate), length.prior, length.highest);
    }
  }
}

// Only samples to which the map leads are asked for: of each site by their looks, up to the first negative one.
void tell_of_signatures(Network& network, const std::map<std::string, bool>& signatures) {
  const auto values = priors(network);
  const std::string prefix = "lander.signature.";
  for (Site& site : network.subway.sites) {
    std::ranges::stable_sort(site.targets, std::greater{},
                             [&](const Target& target) { return evaluate(target.visual, values); });
    bool leads = true;
    std::vector<Target> kept;
    for (const Target& target : site.targets) {
      const std::string sample = network.timelines[target.signature].name.substr(prefix.size());
      if (leads) kept.push_back(target);
      if (!leads) network.tasks[target.task].is_template = true;
      if (const auto known = signatures.find(sample); known != signatures.end())
        leads = leads && known->second;
    }
    site.targets = kept;
  }
}

// The same data may be worth more of one task than of another;
// what a seismometer has recorded comes with the task that parks it.
const Product* product_of(const Network& network, const Course::Product& data) {
  const Product* out = nullptr;
  for (const Task& task : network.tasks)
    for (const Product& product : task.products)
      if (product.name == data.kind && (out == nullptr || data.source.starts_with(task.id + "#")))
        out = &product;
  return out;
}

}  // namespace

Network truth_of(Network foreseen, const HeardFlight& flight, double since_s,
                 const std::map<std::string, bool>& signatures) {
  const Taken taken = taken_in(flight);
  ++foreseen.version;
  tell_of_data(foreseen, flight);
  tell_of_tasks(foreseen, taken);
  tell_of_hotel_load(foreseen, flight, taken);
  tell_of_rate(foreseen, flight, since_s);
  tell_of_lengths(foreseen);
  tell_of_signatures(foreseen, signatures);
  return foreseen;
}

std::vector<double> received(const Network& network, const Course& course) {
  std::vector<double> out(network.ranks.size(), 0.0);
  for (const Course::Product& one : course.products()) {
    if (one.received_s < 0) continue;
    const Product* const product = product_of(network, one);
    if (product == nullptr) continue;
    for (std::size_t rank = 0; rank < out.size(); ++rank) out[rank] += product->utility[rank];
  }
  return out;
}

}  // namespace roci::scenario
