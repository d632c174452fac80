// Which requests can still be done at all, when states once reached count as lasting: every way to do every request,
// one after the other, until nothing new comes to pass.
#include <algorithm>
#include <set>

#include "planner_svc/utility_htn/checking/course.hpp"
#include "planner_svc/utility_htn/checking/parts.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using model::TaskIndex;
using temporal::timelines::Constraint, temporal::timelines::Index;

/// Is a way to do a task: its primitive tasks, and what its decompositions ask for.
struct Way {
  std::vector<TaskIndex> tasks;
  std::vector<Constraint> asks;
};

std::vector<Way> ways_of(const model::Network& network, TaskIndex index) {
  const model::Task& task = network.tasks[index];
  if (task.primitive()) return {{{index}, task.constraints}};
  std::vector<Way> out;
  for (const model::Decomposition& decomposition : task.decompositions) {
    std::vector<Way> begun{{{}, decomposition.when}};
    for (const model::Subtask& subtask : decomposition.subtasks) {
      std::vector<Way> longer;
      for (const Way& head : begun) {
        for (const Way& tail : ways_of(network, subtask.task)) {
          Way& way = longer.emplace_back(head);
          way.tasks.insert(way.tasks.end(), tail.tasks.begin(), tail.tasks.end());
          way.asks.insert(way.asks.end(), tail.asks.begin(), tail.asks.end());
        }
      }
      begun = std::move(longer);
    }
    out.insert(out.end(), begun.begin(), begun.end());
  }
  return out;
}

class Reach {
 public:
  explicit Reach(const Question& question) : question_(question) {
    for (Index timeline = 0; timeline < question.network.timelines.size(); ++timeline)
      reached_.push_back({Course(question, timeline, true).value(question.now, Moment::after)});
    for (const Block& block : question.plan)
      for (const Step& step : block.steps) happens(step.task);
    for (const Step& step : question.rests) happens(step.task);
  }

  std::set<TaskIndex> run() {
    std::set<TaskIndex> left;
    for (TaskIndex task = 0; task < question_.network.tasks.size(); ++task) {
      const bool open = std::ranges::find(question_.closed, task) == question_.closed.end() &&
                        std::ranges::find(question_.broken_off, task) == question_.broken_off.end();
      if (!question_.network.tasks[task].is_template && open) left.insert(task);
    }
    for (bool again = true; again;) {
      again = false;
      for (const TaskIndex task : std::set(left)) {
        for (const Way& way : ways_of(question_.network, task)) {
          const auto before = reached_;
          for (const TaskIndex each : way.tasks) happens(each);
          if (std::ranges::all_of(way.asks, [&](const Constraint& ask) { return holds(ask); })) {
            again = left.erase(task) > 0 || reached_ != before || again;
          } else {
            reached_ = before;
          }
        }
      }
    }
    return left;
  }

 private:
  bool is_state(Index timeline) const {
    return question_.network.timelines[timeline].kind == temporal::timelines::Kind::state;
  }
  void happens(TaskIndex task) {
    for (const model::Impact& impact : question_.network.tasks[task].impacts)
      if (is_state(impact.timeline))
        reached_[impact.timeline].insert(model::evaluate(impact.amount, question_.values));
  }
  // What no task changes, somebody else may.
  bool holds(const Constraint& ask) const {
    const auto changes_it = [&](const model::Task& task) {
      return std::ranges::any_of(task.impacts, [&](const auto& one) { return one.timeline == ask.timeline; });
    };
    if (!is_state(ask.timeline) || std::ranges::none_of(question_.network.tasks, changes_it)) return true;
    return std::ranges::any_of(reached_[ask.timeline], [&](double value) {
      return value >= 0 && value < 64 && ((ask.states >> static_cast<unsigned>(value + 0.5)) & 1U) != 0;
    });
  }

  const Question& question_;
  std::vector<std::set<double>> reached_;  // by timeline
};

}  // namespace

std::set<TaskIndex> out_of_reach(const Question& question) { return Reach(question).run(); }

}  // namespace roci::planner::utility_htn::checking
