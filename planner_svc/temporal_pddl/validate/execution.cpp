#include "planner_svc/temporal_pddl/validate/execution.hpp"

#include <algorithm>
#include <cmath>

#include "core/pddl/printer.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

double in_seconds(pddl::Microseconds time) { return static_cast<double>(time.count()) * 1e-6; }

bool meets(double duration, pddl::ComparisonOperator op, double bound, double tolerance) {
  if (op != pddl::ComparisonOperator::greater_equal && duration > bound + tolerance) return false;
  return op == pddl::ComparisonOperator::less_equal || duration >= bound - tolerance;
}

}  // namespace

Execution::Execution(const Model& model, const std::vector<pddl::PlanStep>& plan,
                     const std::vector<Step>& steps, const Options& options,
                     std::vector<Violation>& violations)
    : model_(model),
      plan_(plan),
      steps_(steps),
      options_(options),
      violations_(violations),
      state_(model.initial_state()) {}

void Execution::happen(std::span<const Event> events, bool crowded) {
  const pddl::Microseconds now = events.front().time;
  std::erase_if(recent_, [&](const Occurrence& old) { return old.event.time + options_.epsilon <= now; });
  const std::size_t before = recent_.size();
  for (const Event& event : events) {
    Occurrence occurrence = execute(event, crowded);
    check_interference(occurrence);
    recent_.push_back(std::move(occurrence));
  }
  // What timed literals delete at a time goes before what they add, as in the effects of one action.
  std::stable_partition(recent_.begin() + static_cast<std::ptrdiff_t>(before), recent_.end(),
                        [](const Occurrence& occurrence) {
                          return occurrence.event.kind == EventKind::timed_literal &&
                                 !occurrence.footprint.changes.deleted.empty();
                        });
  for (std::size_t i = before; i < recent_.size(); ++i) {
    std::string fluent;
    if (apply(recent_[i].footprint.changes, state_, fluent)) continue;
    Violation found = violation(ViolationKind::undefined_value, recent_[i].event.index, now);
    found.message = fluent + " has no value to change, or no finite one afterwards";
    violations_.push_back(std::move(found));
  }
  check_invariants(now);
}

Execution::Occurrence Execution::execute(const Event& event, bool crowded) {
  Occurrence occurrence{event, {}};
  Changes& changes = occurrence.footprint.changes;
  Evaluator evaluator(model_, state_, crowded ? &occurrence.footprint.reads : nullptr);
  switch (event.kind) {
    case EventKind::timed_literal: {
      const pddl::Literal& literal = model_.problem().timed_literals[event.index].literal;
      (literal.negated ? changes.deleted : changes.added).push_back(pddl::print(literal.atom));
      break;
    }
    case EventKind::timed_value: {
      const pddl::TimedValue& timed = model_.problem().timed_values[event.index];
      changes.numeric.push_back({pddl::print(timed.fluent), pddl::AssignmentOperator::assign, timed.value});
      break;
    }
    case EventKind::instant:
      execute_instant(event, evaluator, changes);
      break;
    case EventKind::start:
      execute_start(event, evaluator, changes);
      break;
    case EventKind::end:
      execute_end(event, evaluator, changes);
      break;
  }
  return occurrence;
}

void Execution::execute_instant(const Event& event, Evaluator& evaluator, Changes& changes) {
  const Step& step = steps_[event.index];
  require(step.instantaneous->precondition, step.bindings, evaluator,
          {ViolationKind::condition, event.index, event.time, "precondition"});
  auto effects = unfold(step.instantaneous->effects, step.bindings, model_);
  check_conditions(effects, &pddl::TimedCondition::at_start, evaluator);
  collect_effects(event, effects, {}, evaluator, changes);
}

void Execution::execute_start(const Event& event, Evaluator& evaluator, Changes& changes) {
  const Step& step = steps_[event.index];
  const pddl::DurativeAction& action = *step.durative;
  const pddl::Microseconds duration = *plan_[event.index].duration;
  Running running{event.index, check_duration(event, pddl::TimePoint::start, evaluator),
                  unfold(action.end_effects, step.bindings, model_), false};
  if (!running.duration) running.duration = in_seconds(duration);
  require(action.condition.at_start, step.bindings, evaluator,
          {ViolationKind::condition, event.index, event.time, "condition at start"});
  auto effects = unfold(action.start_effects, step.bindings, model_);
  check_conditions(effects, &pddl::TimedCondition::at_start, evaluator);
  check_conditions(running.end_effects, &pddl::TimedCondition::at_start, evaluator);
  collect_effects(event, effects, {running.duration, {}}, evaluator, changes);
  running_.push_back(std::move(running));
}

void Execution::execute_end(const Event& event, Evaluator& evaluator, Changes& changes) {
  const Step& step = steps_[event.index];
  const auto running = std::find_if(running_.begin(), running_.end(),
                                    [&](const Running& one) { return one.step == event.index; });
  check_duration(event, pddl::TimePoint::end, evaluator);
  require(step.durative->condition.at_end, step.bindings, evaluator,
          {ViolationKind::condition, event.index, event.time, "condition at end"});
  check_conditions(running->end_effects, &pddl::TimedCondition::at_end, evaluator);
  collect_effects(event, running->end_effects, {running->duration, {}}, evaluator, changes);
  running_.erase(running);
}

void Execution::collect_effects(const Event& event, const std::vector<PendingEffect>& effects,
                                const Specials& specials, Evaluator& evaluator, Changes& changes) {
  if (!collect(effects, specials, evaluator, changes)) {
    Violation found = violation(ViolationKind::undefined_value, event.index, event.time);
    found.message = "an effect cannot be computed: " + evaluator.reason();
    violations_.push_back(std::move(found));
  }
  if (const auto fluent = conflict(changes)) {
    Violation found = violation(ViolationKind::conflicting_effects, event.index, event.time);
    found.message = "sets " + *fluent + " in two ways at once";
    violations_.push_back(std::move(found));
  }
}

std::optional<double> Execution::check_duration(const Event& event, pddl::TimePoint at,
                                                Evaluator& evaluator) {
  const Step& step = steps_[event.index];
  const double duration = in_seconds(*plan_[event.index].duration);
  const double tolerance = in_seconds(options_.duration_tolerance) + 1e-9;
  std::optional<double> exact;
  for (const pddl::DurationConstraint& constraint : step.durative->duration) {
    if (constraint.at != at) continue;
    const auto bound = evaluator.value(constraint.bound, step.bindings);
    const bool met = bound && meets(duration, constraint.op, *bound, tolerance);
    if (met) {
      if (constraint.op == pddl::ComparisonOperator::equal) exact = bound;
      continue;
    }
    Violation found = violation(ViolationKind::time, event.index, event.time);
    found.condition = "(" + pddl::print(constraint.op) + " ?duration " +
                      step.bindings.instantiate(pddl::print(constraint.bound)) + ")";
    found.message = "duration " + pddl::print_number(duration) + " against " + found.condition +
                    (bound ? ", which is " + pddl::print_number(*bound) : ": " + evaluator.reason());
    violations_.push_back(std::move(found));
  }
  return exact;
}

void Execution::check_interference(const Occurrence& occurrence) {
  const auto is_timed_fact = [](const Event& event) { return event.kind <= EventKind::timed_value; };
  for (const Occurrence& other : recent_) {
    if (is_timed_fact(occurrence.event) && is_timed_fact(other.event)) continue;
    const auto over = interference(occurrence.footprint, other.footprint);
    if (!over) continue;
    const bool blame_other = is_timed_fact(occurrence.event);
    const Event& culprit = blame_other ? other.event : occurrence.event;
    Violation found = violation(ViolationKind::interference, culprit.index, occurrence.event.time);
    const pddl::Microseconds apart = occurrence.event.time - other.event.time;
    found.message = name(culprit) + " interferes over " + *over + " with " +
                    name(blame_other ? occurrence.event : other.event) + ", " + pddl::print_seconds(apart) +
                    " apart, less than " + pddl::print_seconds(options_.epsilon);
    violations_.push_back(std::move(found));
  }
}

void Execution::check_invariants(pddl::Microseconds now) {
  Evaluator evaluator(model_, state_);
  for (Running& running : running_) {
    const Step& step = steps_[running.step];
    check_conditions(running.end_effects, &pddl::TimedCondition::over_all, evaluator);
    if (running.broken) continue;
    running.broken = !require(step.durative->condition.over_all, step.bindings, evaluator,
                              {ViolationKind::invariant, running.step, now, "condition over all"});
  }
}

void Execution::check_goal(pddl::Microseconds now) {
  Evaluator evaluator(model_, state_);
  require(model_.problem().goal, {}, evaluator, {ViolationKind::goal, {}, now, "goal"});
}

bool Execution::require(const pddl::Condition& condition, const Bindings& bindings, Evaluator& evaluator,
                        const Occasion& occasion) {
  Bindings scratch = bindings;
  return require_part(condition, scratch, evaluator, occasion);
}

bool Execution::require_part(const pddl::Condition& condition, Bindings& bindings, Evaluator& evaluator,
                             const Occasion& occasion) {
  if (const auto* all = std::get_if<pddl::And>(&condition.node)) {
    bool holds = true;
    for (const pddl::Condition& part : all->parts) {
      holds = require_part(part, bindings, evaluator, occasion) && holds;
    }
    return holds;
  }
  const Truth truth = evaluator.evaluate(condition, bindings);
  if (truth == Truth::yes) return true;
  Violation found = violation(occasion.kind, occasion.step, occasion.time);
  found.condition = bindings.instantiate(pddl::print(condition));
  found.message = std::string(occasion.when) + " " + found.condition + " does not hold";
  if (truth == Truth::unknown) found.message += ": " + evaluator.reason();
  const auto* comparison = std::get_if<pddl::Comparison>(&condition.node);
  if (comparison && truth == Truth::no) {
    found.message += ": " + pddl::print_number(*evaluator.value(comparison->left, bindings)) + " against " +
                     pddl::print_number(*evaluator.value(comparison->right, bindings));
  }
  violations_.push_back(std::move(found));
  return false;
}

Violation Execution::violation(ViolationKind kind, std::optional<std::size_t> step,
                               pddl::Microseconds time) const {
  return {kind, step, time, step ? pddl::print(plan_[*step].action) : "", "", ""};
}

std::string Execution::name(const Event& event) const {
  switch (event.kind) {
    case EventKind::timed_literal:
    case EventKind::timed_value:
      return "the timed fact at " + pddl::print_seconds(event.time);
    case EventKind::start:
      return "the start of " + pddl::print(plan_[event.index].action);
    case EventKind::end:
      return "the end of " + pddl::print(plan_[event.index].action);
    case EventKind::instant:
      break;
  }
  return pddl::print(plan_[event.index].action);
}

}  // namespace roci::planner::temporal_pddl::validate
