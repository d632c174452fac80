#include "planner_svc/utility_htn/assessor/learning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

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
    case Measure::value:
      return "value";
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
  const auto& [duration, energy, power, values] = measured;
  switch (measure) {
    case Measure::duration_s:
      return duration;
    case Measure::energy:
      if (energy) return energy;
      return power && duration ? std::optional(*power * *duration) : std::nullopt;
    case Measure::power:
      if (power) return power;
      return energy && duration && *duration > 0 ? std::optional(*energy / *duration) : std::nullopt;
    case Measure::value:
      break;
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

/// Collects what becomes of the measurements of one task.
class Learning {
 public:
  Learning(const Network& network, const Task& task, Values& values)
      : network_(network), task_(task), values_(values) {}

  void take(const Learns& learns, double wanted) {
    const std::string what = std::string("the measured ") + word(learns.measure) + " " + number(wanted);
    if (!std::isfinite(wanted) || wanted < 0) return refuse(what, "it is not a number from 0 on");
    const std::optional<double> value = solve(network_, task_, learns, wanted, values_);
    if (!value)
      return refuse(what,
                    "what is predicted of the task does not depend on '" + parameter(learns).name + "'");
    set(learns, *value, what);
  }

  void take_value(const Learns& learns, const std::map<std::string, double>& brought) {
    const auto found = brought.find(learns.result);
    if (found == brought.end())
      return refuse("the value '" + learns.result + "'", "its commands brought no number of this name");
    set(learns, found->second, "the value '" + learns.result + "' " + number(found->second));
  }

  Learned done() { return std::move(out_); }

 private:
  const Parameter& parameter(const Learns& learns) const { return network_.parameters.at(learns.parameter); }

  void set(const Learns& learns, double value, const std::string& what) {
    const Parameter& known = parameter(learns);
    if (!known.permits(value) || !std::isfinite(value))
      return refuse(what, "'" + known.name + "' would be " + number(value) + ", outside of " +
                              number(known.lowest) + " to " + number(known.highest));
    values_[learns.parameter] = value;
    out_.replaced.push_back(learns.parameter);
  }

  void refuse(const std::string& what, const std::string& why) {
    out_.refused.push_back(what + " of '" + task_.id + "' is not taken over: " + why);
  }

  const Network& network_;
  const Task& task_;
  Values& values_;
  Learned out_;
};

}  // namespace

Learned learn(const Network& network, model::TaskIndex index, const Measured& measured, Values& values) {
  const Task& task = network.tasks.at(index);
  Learning out(network, task, values);
  for (const Measure measure : {Measure::duration_s, Measure::power, Measure::energy}) {
    const std::optional<double> wanted = measured_value(measured, measure);
    for (const Learns& learns : task.learns)
      if (wanted && learns.measure == measure) out.take(learns, *wanted);
  }
  for (const Learns& learns : task.learns)
    if (measured.values && learns.measure == Measure::value) out.take_value(learns, *measured.values);
  return out.done();
}

}  // namespace roci::planner::utility_htn::assessor
