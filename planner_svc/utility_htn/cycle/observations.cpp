#include "planner_svc/utility_htn/cycle/observations.hpp"

#include <algorithm>
#include <cmath>

namespace roci::planner::utility_htn::cycle {

using temporal::Time;
using temporal::timelines::Index;

Observations::Observations(const model::Network& network, double noticeable)
    : network_(network), noticeable_(noticeable), deviation_(network.timelines.size(), 0.0) {}

bool Observations::take(Index timeline, Time sampled, double value, double foreseen) {
  note(timeline, sampled, value);
  const auto& definition = network_.timelines[timeline];
  if (definition.kind == temporal::timelines::Kind::state) return foreseen != value;
  deviation_[timeline] += std::abs(value - foreseen);
  const double first = std::max(std::abs(definition.initial), 1e-9);
  return deviation_[timeline] > noticeable_ * first;
}

void Observations::note(Index timeline, Time at, double value) {
  const auto [known, first_one] = newest_.try_emplace(timeline, Sample{at, value});
  if (!first_one && known->second.sampled <= at) known->second = {at, value};
}

void Observations::forget_deviations() { std::ranges::fill(deviation_, 0.0); }

void Observations::await(const model::Task& ended, Time at) {
  if (ended.commands.empty()) return;
  for (const model::Impact& impact : ended.impacts)
    if (model::sets_reported_state(network_, impact)) awaited_[impact.timeline] = at;
}

std::vector<std::pair<Index, double>> Observations::take_unconfirmed(Time now) {
  std::vector<std::pair<Index, double>> out;
  std::erase_if(awaited_, [&](const auto& awaited) {
    const auto [timeline, since] = awaited;
    const auto newest = newest_.find(timeline);
    if (newest == newest_.end() || newest->second.sampled > since) return true;
    if (now < since + network_.cycle.process_interval) return false;
    out.emplace_back(timeline, newest->second.value);
    return true;
  });
  return out;
}

bool Observations::is_newest(Index timeline, Time sampled) const {
  const auto known = newest_.find(timeline);
  return known == newest_.end() || known->second.sampled < sampled;
}

std::optional<double> Observations::newest(Index timeline) const {
  const auto known = newest_.find(timeline);
  return known == newest_.end() ? std::nullopt : std::optional(known->second.value);
}

}  // namespace roci::planner::utility_htn::cycle
