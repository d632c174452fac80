// Hierarchy and times: each block is a way to do its request, and starts when it may.
#include <algorithm>
#include <set>

#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using temporal::Duration, temporal::Time;

bool holds(const Question& question, const temporal::timelines::Constraint& constraint, Time at) {
  const double value = Course(question, constraint.timeline, false).value(at, Moment::between);
  if (question.network.timelines[constraint.timeline].kind == temporal::timelines::Kind::state) {
    return value >= 0 && value < 64 && ((constraint.states >> static_cast<unsigned>(value + 0.5)) & 1U) != 0;
  }
  return within(value, constraint.lowest, constraint.highest);
}

// Returns up to which steps the task can account for those from `step` on, trying every decomposition.
// The gap is that to the step before.
std::set<std::size_t> ends_of(const Question& question, const Block& block, model::TaskIndex index,
                              std::size_t step, Duration shortest, Duration longest) {
  const model::Task& task = question.network.tasks[index];
  if (task.primitive()) {
    if (step >= block.steps.size() || block.steps[step].task != index) return {};
    if (step > 0) {
      const Duration gap = block.steps[step].start - end_of(question, block.steps[step - 1]);
      // What was executed comes as it comes; the bounds are the plan's.
      const bool too_long = gap > longest && !block.steps[step - 1].overdue;
      if (!block.steps[step].committed && (gap < shortest || too_long)) return {};
    }
    return {step + 1};
  }
  std::set<std::size_t> out;
  for (const model::Decomposition& decomposition : task.decompositions) {
    if (step >= block.steps.size()) break;
    const bool possible =
        block.steps[step].committed || std::ranges::all_of(decomposition.when, [&](const auto& condition) {
          return holds(question, condition, block.steps[step].start);
        });
    if (!possible) continue;
    std::set<std::size_t> reached{step};
    for (std::size_t s = 0; s < decomposition.subtasks.size(); ++s) {
      const model::Subtask& subtask = decomposition.subtasks[s];
      std::set<std::size_t> next;
      for (const std::size_t at : reached) {
        const auto ends =
            s == 0 ? ends_of(question, block, subtask.task, at, shortest, longest)
                   : ends_of(question, block, subtask.task, at, subtask.shortest_gap, subtask.longest_gap);
        next.insert(ends.begin(), ends.end());
      }
      reached = std::move(next);
    }
    out.insert(reached.begin(), reached.end());
  }
  return out;
}

}  // namespace

void check_blocks(const Question& question, Faults& out) {
  std::set<model::TaskIndex> requests;
  for (const Block& block : question.plan) {
    const std::string who = "request '" + question.network.tasks[block.request].id + "'";
    if (!requests.insert(block.request).second) out.push_back(who + " is planned twice");
    const bool is_new = std::ranges::none_of(block.steps, [](const Step& step) { return step.committed; });
    if (is_new && std::ranges::find(question.closed, block.request) != question.closed.end()) {
      out.push_back(who + " is planned although it is closed");
    }
    const auto ends = ends_of(question, block, block.request, 0, -temporal::no_bound, temporal::no_bound);
    if (!ends.contains(block.steps.size())) {
      out.push_back(who +
                    ": its steps are no decomposition that can be chosen then, with its order and gaps");
    }
  }
}

void check_times(const Question& question, Faults& out) {
  for (const Block& block : question.plan) {
    for (const Step& step : block.steps) {
      if (step.committed) continue;
      const model::Task& task = question.network.tasks[step.task];
      const Time end = end_of(question, step);
      const std::string who = name(question, step);
      if (step.start < question.from) {
        out.push_back(who + " starts before the end of the commit window, " +
                      temporal::to_text(question.from) + ", and is not committed");
      }
      // What is fixed at the very beginning starts when the first commit window has ended.
      const Time fixed = std::max(task.preferred_start, question.origin + question.network.cycle.commit_window);
      if (task.fixed && step.start != fixed)
        out.push_back(who + " does not start at its fixed time, " + temporal::to_text(fixed));
      if (step.start < task.opens)
        out.push_back(who + " starts before its window opens at " + temporal::to_text(task.opens));
      if (end > task.closes)
        out.push_back(who + " ends after its window closes at " + temporal::to_text(task.closes));
      if (end > question.network.cycle.plan_end) {
        out.push_back(who + " ends after the end of the plan, " +
                      temporal::to_text(question.network.cycle.plan_end));
      }
    }
  }
}

}  // namespace roci::planner::utility_htn::checking
