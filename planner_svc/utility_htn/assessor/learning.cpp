#include "planner_svc/utility_htn/assessor/learning.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/temporal/value.hpp"

namespace roci::planner::utility_htn::assessor {

using model::Learns, model::Measure, model::Network, model::Parameter, model::Task, model::Values;

namespace {

const char* word(Measure measure) {
  switch (measure) {
    case Measure::duration_s:
      return "duration";
    case Measure::energy:
      return "energy";
    case Measure::power:
      return "power";
  }
  return "";
}

std::string number(double value) { return temporal::to_text(temporal::Value{value}); }

double predicted(const Network& network, const Task& task, Measure measure, const Values& values) {
  const double duration = model::duration_s(task, values);
  if (measure == Measure::duration_s) return duration;
  const double energy = model::cost(network, task, values);
  return measure == Measure::energy ? energy : energy / duration;
}

std::optional<double> measured_value(const Measured& measured, Measure measure) {
  const auto& [duration, energy, power] = measured;
  switch (measure) {
    case Measure::duration_s:
      return duration;
    case Measure::energy:
      if (energy) return energy;
      return power && duration ? std::optional(*power * *duration) : std::nullopt;
    case Measure::power:
      if (power) return power;
      return energy && duration && *duration > 0 ? std::optional(*energy / *duration) : std::nullopt;
  }
  return std::nullopt;
}

// The parameter's value with which the task's prediction, which is linear in it, is what was measured.
std::optional<double> solve(const Network& network, const Task& task, const Learns& learns, double wanted,
                            Values values) {
  const double here = values[learns.parameter];
  const double step = std::max(1.0, std::abs(here));
  const double predicted_here = predicted(network, task, learns.measure, values);
  values[learns.parameter] = here + step;
  const double slope = (predicted(network, task, learns.measure, values) - predicted_here) / step;
  if (slope == 0 || !std::isfinite(slope)) return std::nullopt;
  return here + (wanted - predicted_here) / slope;
}

}  // namespace

Learned learn(const Network& network, model::TaskIndex index, const Measured& measured, Values& values) {
  const Task& task = network.tasks.at(index);
  Learned out;
  for (const Measure measure : {Measure::duration_s, Measure::power, Measure::energy}) {
    const std::optional<double> wanted = measured_value(measured, measure);
    if (!wanted) continue;
    for (const Learns& learns : task.learns) {
      if (learns.measure != measure) continue;
      const Parameter& parameter = network.parameters.at(learns.parameter);
      const std::string what =
          std::string("the measured ") + word(measure) + " " + number(*wanted) + " of '" + task.id + "'";
      if (!std::isfinite(*wanted) || *wanted < 0) {
        out.refused.push_back(what + " is not taken over: it is not a number from 0 on");
        continue;
      }
      const std::optional<double> value = solve(network, task, learns, *wanted, values);
      if (!value) {
        out.refused.push_back(what +
                              " is not taken over: what is predicted of the task does not depend on '" +
                              parameter.name + "'");
      } else if (!parameter.permits(*value)) {
        out.refused.push_back(what + " is not taken over: '" + parameter.name + "' would be " +
                              number(*value) + ", outside of " + number(parameter.lowest) + " to " +
                              number(parameter.highest));
      } else {
        values[learns.parameter] = *value;
        out.replaced.push_back(learns.parameter);
      }
    }
  }
  return out;
}

}  // namespace roci::planner::utility_htn::assessor
