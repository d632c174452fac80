// Conditions of steps and ranges of timelines, looked at wherever something changes.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using temporal::Time;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

bool allows(const Definition& timeline, const Constraint& constraint, double value) {
  if (timeline.kind != Kind::state) return within(value, constraint.lowest, constraint.highest);
  const long state = std::lround(value);
  return state >= 0 && state < 64 && ((constraint.states >> static_cast<unsigned>(state)) & 1U) != 0;
}

// Returns the first time and value at which a condition of the step is broken.
std::optional<std::pair<Time, double>> broken(const Question& question, const Step& step,
                                              const Constraint& constraint, const Course& course) {
  const Definition& timeline = question.network.timelines[constraint.timeline];
  const Time end = end_of(question, step);
  const auto look = [&](Time at, Moment moment) -> std::optional<std::pair<Time, double>> {
    const double value = course.value(at, moment);
    if (allows(timeline, constraint, value)) return std::nullopt;
    return std::pair(at, value);
  };
  if (constraint.phase == Phase::pre) return look(step.start, Moment::between);
  if (constraint.phase == Phase::post) return look(end, end > step.start ? Moment::between : Moment::after);
  if (end == step.start) return std::nullopt;
  if (const auto found = look(step.start, Moment::after)) return found;
  for (const Time at : course.changes()) {
    if (at <= step.start || at >= end) continue;
    for (const Moment moment : {Moment::before, Moment::between, Moment::after}) {
      if (const auto found = look(at, moment)) return found;
    }
  }
  return look(end, Moment::before);
}

std::string words(Phase phase) {
  if (phase == Phase::pre) return "precondition";
  return phase == Phase::maintenance ? "maintenance condition" : "postcondition";
}

std::string allowed(const Definition& timeline, const Constraint& constraint) {
  if (timeline.kind != Kind::state) return number(constraint.lowest) + " to " + number(constraint.highest);
  std::string out;
  for (std::size_t state = 0; state < timeline.states.size(); ++state) {
    if ((constraint.states >> state) & 1U) out += (out.empty() ? "" : " or ") + timeline.states[state];
  }
  return out;
}

std::string value_text(const Definition& timeline, double value) {
  const long state = std::lround(value);
  const bool named =
      timeline.kind == Kind::state && state >= 0 && state < static_cast<long>(timeline.states.size());
  return named ? timeline.states[static_cast<std::size_t>(state)] : number(value);
}

std::optional<std::pair<Time, double>> leaves_range(const Question& question, const Definition& timeline,
                                                    const Course& course, Time until) {
  std::vector<Time> times{question.from};
  for (const Time at : course.changes()) {
    if (at > question.from) times.push_back(at);
  }
  if (until > times.back()) times.push_back(until);
  const double lowest = timeline.kind == Kind::state ? 0 : timeline.lowest;
  const double highest =
      timeline.kind == Kind::state ? static_cast<double>(timeline.states.size()) - 1 : timeline.highest;
  for (const Time at : times) {
    for (const Moment moment : {Moment::before, Moment::between, Moment::after}) {
      if (at == question.from && moment != Moment::after) continue;
      const double value = course.value(at, moment);
      if (!within(value, lowest, highest)) return std::pair(at, value);
    }
  }
  return std::nullopt;
}

}  // namespace

void check_conditions(const Question& question, Faults& out) {
  for (const Block& block : question.plan) {
    for (const Step& step : block.steps) {
      if (end_of(question, step) <= question.now) continue;  // what is over is over
      for (const Constraint& constraint : question.network.tasks[step.task].constraints) {
        if (step.committed && constraint.phase == Phase::pre && step.start <= question.now) continue;
        const Course course(question, constraint.timeline, false);
        const auto fault = broken(question, step, constraint, course);
        if (!fault) continue;
        if (step.committed && broken(question, step, constraint, Course(question, constraint.timeline, true)))
          continue;
        const Definition& timeline = question.network.timelines[constraint.timeline];
        out.push_back(name(question, step) + ": its " + words(constraint.phase) + " on '" + timeline.name +
                      "' is broken at " + temporal::to_text(fault->first) + ", where the value is " +
                      value_text(timeline, fault->second) + " and not " + allowed(timeline, constraint));
      }
    }
  }
}

void check_ranges(const Question& question, Faults& out) {
  Time until = question.from;
  for (const Block& block : question.plan) {
    for (const Step& step : block.steps) until = std::max(until, end_of(question, step));
  }
  for (std::uint32_t index = 0; index < question.network.timelines.size(); ++index) {
    const Definition& timeline = question.network.timelines[index];
    const auto fault = leaves_range(question, timeline, Course(question, index, false), until);
    if (!fault) continue;
    const auto anyway = leaves_range(question, timeline, Course(question, index, true), until);
    if (anyway && anyway->first <= fault->first) continue;
    out.push_back("timeline '" + timeline.name + "' leaves its range at " + temporal::to_text(fault->first) +
                  ": its value is " + number(fault->second) + ", the range " + number(timeline.lowest) +
                  " to " + number(timeline.highest));
  }
}

}  // namespace roci::planner::utility_htn::checking
