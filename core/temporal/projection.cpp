#include "core/temporal/projection.hpp"

#include <algorithm>
#include <tuple>

#include "core/temporal/schedule.hpp"

namespace roci::temporal {
namespace {

// Says when an activity starts and ends, and which of that has come about. What is empty does not happen.
struct Span {
  std::optional<Time> start, end;
  ProjectionKind start_kind = ProjectionKind::planned;
  ProjectionKind end_kind = ProjectionKind::planned;
  bool achieves = true;  // what it does at its end comes about
};

std::vector<Span> planned_spans(const FlexiblePlan& plan) {
  std::vector<Span> out(plan.activities.size());
  const auto times = earliest_schedule(plan.point_count, all_constraints(plan));
  if (!times) return out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].start = plan.origin + (*times)[plan.activities[i].start_point];
    out[i].end = plan.origin + (*times)[plan.activities[i].end_point];
  }
  return out;
}

ActivityProgress progress_of(const PlanActivity& activity, const Progress& progress) {
  const auto found = progress.find(activity.id);
  return found == progress.end() ? ActivityProgress{} : found->second;
}

// Returns the earliest times that are left: what has happened stands, what has not comes no earlier than now,
// and no deadline is asked, since a missed one does not end a projection.
std::vector<Duration> earliest_now(const FlexiblePlan& plan, const Progress& progress, Time now) {
  enum class Point { open, fixed, gone };
  std::vector<Point> points(plan.point_count, Point::open);
  std::vector<Duration> least(plan.point_count, std::max(now - plan.origin, Duration{0}));
  const auto fix = [&](TimePoint point, Time time) {
    points[point] = Point::fixed;
    least[point] = std::max(time - plan.origin, Duration{0});
  };
  fix(origin_point, plan.origin);
  for (const PlanActivity& activity : plan.activities) {
    const ActivityProgress at = progress_of(activity, progress);
    if (is_over(at.state)) points[activity.start_point] = points[activity.end_point] = Point::gone;
    if (at.started) fix(activity.start_point, *at.started);
    if (at.started && at.ended) fix(activity.end_point, *at.ended);
  }
  std::vector<TemporalConstraint> bounds;
  for (TimePoint point = 1; point < plan.point_count; ++point)
    bounds.push_back({origin_point, point, ConstraintKind::window, least[point], no_bound});
  const auto add = [&](TimePoint from, TimePoint to, Duration lower) {
    if (points[from] != Point::gone && points[to] == Point::open)
      bounds.push_back({from, to, ConstraintKind::ordering, lower, no_bound});
  };
  for (const TemporalConstraint& constraint : all_constraints(plan)) {
    add(constraint.from_point, constraint.to_point, constraint.lower);
    if (bounded(constraint.upper)) add(constraint.to_point, constraint.from_point, -constraint.upper);
  }
  return earliest_schedule(plan.point_count, bounds).value_or(least);
}

std::vector<Span> real_spans(const FlexiblePlan& plan, const Progress& progress, Time now) {
  const std::vector<Duration> earliest = earliest_now(plan, progress, now);
  std::vector<Span> out;
  for (const PlanActivity& activity : plan.activities) {
    const ActivityProgress at = progress_of(activity, progress);
    Span& span = out.emplace_back();
    span.start_kind = at.started ? ProjectionKind::executed : ProjectionKind::projected;
    span.end_kind = at.ended ? ProjectionKind::executed : ProjectionKind::projected;
    span.achieves = !is_over(at.state) || at.state == ActivityState::succeeded;
    span.start = at.started;
    if (at.started) span.end = at.ended;
    if (is_over(at.state)) continue;
    if (!span.start) span.start = plan.origin + earliest[activity.start_point];
    span.end = plan.origin + earliest[activity.end_point];
  }
  return out;
}

// Is one impact at one end of its activity. At one time ends come before starts, but an activity's own start
// before its end.
struct Event {
  Time time{0};
  int turn = 0;
  std::size_t activity = 0;
  const Impact* impact = nullptr;
  bool begins = false;  // of a rate
  ProjectionKind kind = ProjectionKind::planned;
  auto order() const { return std::tuple(time, turn, activity); }
};

std::map<std::string, std::vector<Event>> events_of(const FlexiblePlan& plan,
                                                    const std::vector<Span>& spans) {
  std::map<std::string, std::vector<Event>> out;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Span& span = spans[i];
    const int end_turn = span.start == span.end ? 2 : 0;
    for (const Impact& impact : plan.activities[i].impacts) {
      const bool rate = impact.kind == ImpactKind::rate;
      if (span.start && (rate || impact.moment != ImpactWhen::at_end))
        out[impact.timeline].push_back({*span.start, 1, i, &impact, true, span.start_kind});
      if (span.start && span.end && (rate || (impact.moment == ImpactWhen::at_end && span.achieves)))
        out[impact.timeline].push_back({*span.end, end_turn, i, &impact, false, span.end_kind});
    }
  }
  for (auto& [timeline, events] : out)
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return a.order() < b.order(); });
  return out;
}

// Carries a value under impacts from event to event.
class Sweep {
 public:
  explicit Sweep(Value initial) : value_(std::move(initial)) {}

  const Value& take(const Event& event) {
    advance(event.time);
    const double* amount = std::get_if<double>(&event.impact->amount);
    if (event.impact->kind == ImpactKind::assign) {
      value_ = event.impact->amount;
    } else if (amount != nullptr && event.impact->kind == ImpactKind::delta) {
      value_ = number() + *amount;
    } else if (amount != nullptr) {
      rate_ += event.begins ? *amount : -*amount;
      value_ = number();
    }
    return value_;
  }

  // What was seen counts more than what was reckoned; what runs goes on from there.
  void correct(const ObservedValue& seen) {
    advance(seen.sampled);
    value_ = seen.value;
  }

  double number_at(Time time) {
    advance(time);
    return number();
  }

 private:
  double number() const {
    const double* held = std::get_if<double>(&value_);
    return held == nullptr ? 0.0 : *held;
  }
  void advance(Time to) {
    if (rate_ != 0) value_ = number() + rate_ * to_seconds(to - at_);
    at_ = to;
  }

  Value value_;
  double rate_ = 0;
  Time at_{0};
};

}  // namespace

const char* to_string(ProjectionKind kind) {
  switch (kind) {
    case ProjectionKind::planned:
      return "planned";
    case ProjectionKind::executed:
      return "executed";
    case ProjectionKind::projected:
      return "projected";
  }
  return "unknown";
}

namespace {

using Changes = std::vector<ProjectedChange>;

// Returns whether the observation shows what the event has done.
bool shown_in(const Event& event, const ObservedValue& seen) {
  return event.kind == ProjectionKind::executed && event.time <= seen.sampled;
}

void sweep(const std::vector<Event>& events, const FlexiblePlan& plan, const Value& initial,
           const ObservedValue* seen, Changes& out) {
  Sweep values(initial);
  const auto correct = [&] {
    values.correct(*seen);
    out.push_back({seen->sampled, seen->value, ProjectionKind::executed, ""});
    seen = nullptr;
  };
  for (const Event& event : events) {
    if (seen != nullptr && !shown_in(event, *seen)) correct();
    out.push_back({event.time, values.take(event), event.kind, plan.activities[event.activity].id});
  }
  if (seen != nullptr) correct();
}

// A number with which the plan began, reckoned back from what was seen by what had been executed until then. None where
// that cannot be told, since an activity had assigned a value.
Value reckoned_back(const std::vector<Event>& events, const ObservedValue& seen) {
  const double* number = std::get_if<double>(&seen.value);
  if (number == nullptr) return {};
  Sweep changes(0.0);
  for (const Event& event : events) {
    if (!shown_in(event, seen)) break;
    if (event.impact->kind == ImpactKind::assign) return {};
    changes.take(event);
  }
  return *number - changes.number_at(seen.sampled);
}

}  // namespace

std::map<std::string, std::vector<ProjectedChange>> project(const FlexiblePlan& plan,
                                                            const Progress& progress, Time now,
                                                            const std::map<std::string, Value>& initial,
                                                            const ObservedValues& observed) {
  const auto real = events_of(plan, real_spans(plan, progress, now));
  const auto seen_of = [&](const std::string& timeline) {
    const auto seen = observed.find(timeline);
    return seen == observed.end() ? nullptr : &seen->second;
  };
  const auto value_at_start = [&](const std::string& timeline) {
    if (const auto known = initial.find(timeline); known != initial.end()) return known->second;
    const ObservedValue* seen = seen_of(timeline);
    if (seen == nullptr) return Value{};
    const auto events = real.find(timeline);
    return reckoned_back(events == real.end() ? std::vector<Event>{} : events->second, *seen);
  };
  std::map<std::string, Changes> out;
  for (const auto& [timeline, events] : events_of(plan, planned_spans(plan)))
    sweep(events, plan, value_at_start(timeline), nullptr, out[timeline]);
  for (const auto& [timeline, events] : real)
    sweep(events, plan, value_at_start(timeline), seen_of(timeline), out[timeline]);
  return out;
}

}  // namespace roci::temporal
