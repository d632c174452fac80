#include "planner_svc/utility_htn/checking/course.hpp"

#include <algorithm>
#include <tuple>

namespace roci::planner::utility_htn::checking {

using temporal::ImpactKind, temporal::ImpactWhen, temporal::Time;

namespace {

int turn(ImpactKind kind) {
  if (kind == ImpactKind::assign) return 0;
  return kind == ImpactKind::delta ? 1 : 2;
}

}  // namespace

Time end_of(const Question& question, const Step& step) {
  if (step.duration) return step.start + *step.duration;
  const double seconds = model::evaluate(question.network.tasks[step.task].duration, question.values);
  return step.start + temporal::seconds(std::max(0.0, seconds));
}

Course::Course(const Question& question, temporal::timelines::Index timeline, bool committed_only)
    : initial_(question.network.timelines[timeline].initial) {
  for (const Observation& observation : question.observations) {
    if (observation.timeline != timeline || (observed_ && observation.sampled < anchor_)) continue;
    observed_ = true;
    anchor_ = observation.sampled;
    initial_ = observation.value;
  }
  for (const Step& step : question.rests) add(question, timeline, step);
  for (const Block& block : question.plan)
    for (const Step& step : block.steps)
      if (!committed_only || step.committed) add(question, timeline, step);
  std::ranges::stable_sort(all_, {}, [](const Change& change) {
    return std::tuple(change.at, change.starts, turn(change.kind), change.step);
  });
  for (const Change& change : all_) changes_.push_back(change.at);
  changes_.erase(std::unique(changes_.begin(), changes_.end()), changes_.end());
}

void Course::add(const Question& question, temporal::timelines::Index timeline, const Step& step) {
  // What is due just now the network's own timelines hold already; a reported one does when it is told.
  const bool late = step.overdue || (step.due && question.network.timelines[timeline].reported);
  for (const model::Impact& impact : question.network.tasks[step.task].impacts) {
    if (impact.timeline != timeline) continue;
    const double amount = model::evaluate(impact.amount, question.values);
    const bool at_end = impact.moment == ImpactWhen::at_end;
    const bool during = impact.moment == ImpactWhen::during;
    const Time end = end_of(question, step);
    const bool point = end == step.start;  // all that it does it does when it starts
    if (point && during) continue;
    all_.push_back({at_end ? end : step.start, !at_end || point, impact.kind, step.id, amount, late});
    if (during && impact.kind != ImpactKind::assign)
      all_.push_back({end, false, impact.kind, step.id, -amount, late});
  }
}

double Course::value(Time at, Moment moment) const {
  double value = initial_;
  double rate = 0;
  Time reached = anchor_;
  for (const Change& change : all_) {
    const bool is_now = change.at == at;
    if (change.at > at || (is_now && moment == Moment::before)) break;
    if (is_now && change.starts && moment == Moment::between) break;
    const bool counts = !observed_ || change.at > anchor_ || (change.late && change.at == anchor_);
    if (counts && change.at > reached) {
      value += rate * temporal::to_seconds(change.at - reached);
      reached = change.at;
    }
    if (change.kind == ImpactKind::rate) rate += change.amount;
    if (counts && change.kind == ImpactKind::delta) value += change.amount;
    if (counts && change.kind == ImpactKind::assign) value = change.amount;
  }
  return at > reached ? value + rate * temporal::to_seconds(at - reached) : value;
}

}  // namespace roci::planner::utility_htn::checking
