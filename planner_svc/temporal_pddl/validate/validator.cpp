#include "planner_svc/temporal_pddl/validate/validator.hpp"

#include <algorithm>
#include <span>

#include "planner_svc/temporal_pddl/validate/execution.hpp"

namespace roci::planner::temporal_pddl::validate {

namespace {

// Returns how many events from the front share one moment.
std::size_t count_simultaneous(std::span<const Event> events) {
  const auto later = std::find_if(events.begin(), events.end(),
                                  [&](const Event& event) { return event.time != events.front().time; });
  return static_cast<std::size_t>(later - events.begin());
}

}  // namespace

Report validate(const pddl::Domain& domain, const pddl::Problem& problem,
                const std::vector<pddl::PlanStep>& plan, const pddl::FunctionTable& functions,
                const Options& options) {
  const Model model(domain, problem, functions);
  Report report;
  const std::vector<Step> steps = resolve(plan, model, report.violations);
  const std::vector<Event> events = schedule(plan, steps, problem);
  if (!events.empty()) report.makespan = events.back().time;

  Execution execution(model, plan, steps, options, report.violations);
  for (std::size_t i = 0; i < events.size();) {
    const std::size_t count = count_simultaneous(std::span(events).subspan(i));
    const std::size_t next = i + count;
    const pddl::Microseconds now = events[i].time;
    const bool crowded = count > 1 || (i > 0 && now - events[i - 1].time < options.epsilon) ||
                         (next < events.size() && events[next].time - now < options.epsilon);
    execution.happen(std::span(events).subspan(i, count), crowded);
    i = next;
  }
  execution.check_goal(report.makespan);

  std::stable_sort(report.violations.begin(), report.violations.end(),
                   [](const Violation& a, const Violation& b) { return a.time < b.time; });
  report.valid = report.violations.empty();
  if (report.valid && problem.metric) {
    Evaluator evaluator(model, execution.state());
    const double makespan = static_cast<double>(report.makespan.count()) * 1e-6;
    report.metric = evaluator.value(problem.metric->expression, {}, {.duration = {}, .total_time = makespan});
  }
  return report;
}

}  // namespace roci::planner::temporal_pddl::validate
