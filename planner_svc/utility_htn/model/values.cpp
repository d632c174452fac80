#include <algorithm>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {

using temporal::ImpactKind, temporal::ImpactWhen;

Values priors(const Network& network) {
  Values out;
  out.reserve(network.parameters.size());
  for (const Parameter& parameter : network.parameters) out.push_back(parameter.prior);
  return out;
}

double evaluate(const Amount& amount, const Values& values) {
  return amount.parameter ? amount.constant + amount.factor * values.at(*amount.parameter) : amount.constant;
}

double duration_s(const Task& task, const Values& values) {
  return std::max(0.0, evaluate(task.duration, values));
}

temporal::timelines::Footprint footprint(const Task& task, const Values& values) {
  temporal::timelines::Footprint out;
  out.duration = temporal::seconds(duration_s(task, values));
  out.impacts.reserve(task.impacts.size());
  for (const Impact& impact : task.impacts)
    out.impacts.push_back({impact.timeline, impact.kind, impact.moment, evaluate(impact.amount, values)});
  out.constraints = task.constraints;
  return out;
}

double cost(const Network& network, const Task& task, const Values& values) {
  double out = 0;
  for (const Impact& impact : task.impacts) {
    if (impact.timeline != network.budget) continue;
    const double amount = evaluate(impact.amount, values);
    if (impact.kind == ImpactKind::delta && impact.moment != ImpactWhen::during) out -= amount;
    if (impact.kind == ImpactKind::rate && impact.moment != ImpactWhen::at_end)
      out -= amount * duration_s(task, values);
  }
  return out;
}

bool sets_reported_state(const Network& network, const Impact& impact) {
  const auto& timeline = network.timelines[impact.timeline];
  return impact.kind == temporal::ImpactKind::assign && timeline.reported &&
         timeline.kind == temporal::timelines::Kind::state;
}

double draw(const Network& network, const Task& task, const Values& values) {
  double out = 0;
  for (const Impact& impact : task.impacts)
    if (impact.timeline == network.budget && impact.kind == ImpactKind::rate)
      out -= evaluate(impact.amount, values);
  return out;
}

temporal::RankVector utility(const Task& task, const Values& values) {
  std::vector<double> scores;
  scores.reserve(task.utility.size());
  for (const Amount& score : task.utility) scores.push_back(evaluate(score, values));
  return temporal::RankVector(std::move(scores));
}

}  // namespace roci::planner::utility_htn::model
