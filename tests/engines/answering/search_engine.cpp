#include "tests/engines/answering/search_engine.hpp"

#include <algorithm>
#include <map>
#include <queue>
#include <set>

#include "tests/engines/model/task_model.hpp"

namespace roci::planner::proof {

using engine::Answer, engine::BlockingGoal, engine::FunctionOutcome, engine::FunctionSource, engine::Goal,
    engine::Limits, engine::Request, engine::Timelines;
using temporal::Duration, temporal::Truth, temporal::Verdict;

namespace {

struct Node {
  Timelines state;
  Duration time{0};
  std::size_t parent = 0;
  const Task* task = nullptr;  // that led here
};

// Orders states in a map.
std::string key_of(const Timelines& state) {
  std::string key;
  for (const auto& [timeline, value] : state) key += timeline + "=" + temporal::to_text(value) + ";";
  return key;
}

Truth evaluate(const temporal::Condition& condition, const Timelines& state) {
  return temporal::evaluate(condition, [&](const std::string& timeline) -> std::optional<temporal::Value> {
    const auto found = state.find(timeline);
    return found == state.end() ? std::nullopt : std::optional(found->second);
  });
}

bool holds(const Held& held, const Timelines& state) {
  const auto found = state.find(held.timeline);
  return found != state.end() && found->second == temporal::state(held.value);
}

double number(const std::string& timeline, const Timelines& state) {
  const auto found = state.find(timeline);
  const double* value = found == state.end() ? nullptr : std::get_if<double>(&found->second);
  return value == nullptr ? 0 : *value;
}

class Search {
 public:
  Search(const Request& request, const Limits& limits, TaskModel model)
      : request_(request), limits_(limits), model_(std::move(model)) {}

  // What goes wrong before the search: a duration that nobody knows.
  std::optional<Answer> ask_durations(FunctionSource& functions) {
    for (Task& task : model_.tasks) {
      if (task.function.empty()) continue;
      const std::vector<engine::FunctionCall> calls{{task.module_name, task.function, {task.name}}};
      const auto values = functions.evaluate(calls, limits_.cancelled);
      if (limits_.cancelled()) return engine::without_plan(Verdict::cancelled, "cancelled by the caller");
      if (values.size() == 1 && values[0].outcome == FunctionOutcome::value) {
        task.duration = temporal::seconds(values[0].value);
        uses_.push_back({task.function,
                         {task.name},
                         values[0].value,
                         values[0].provenance->owner,
                         0,
                         values[0].provenance->time});
      } else {
        return engine::without_plan(Verdict::function_unavailable,
                                    task.function + " of '" + task.name + "' is not known: " +
                                        (values.empty() ? "no answer" : values[0].reason));
      }
    }
    return std::nullopt;
  }

  Answer run() {
    nodes_.push_back({request_.state});
    open_.push({Duration{0}, 0});
    best_[key_of(request_.state)] = Duration{0};
    while (!open_.empty()) {
      if (limits_.cancelled())
        return finish(engine::without_plan(Verdict::cancelled, "cancelled by the caller"));
      if (limits_.out_of_time() || (request_.work != 0 && expanded_ >= request_.work))
        return finish(engine::without_plan(Verdict::timeout, "the budget is spent"));
      const auto [time, index] = open_.top();
      open_.pop();
      if (time > best_.at(key_of(nodes_[index].state))) continue;
      if (is_goal(nodes_[index].state)) return finish(solved(index));
      expand(index);
    }
    return finish(unsolvable());
  }

 private:
  bool is_goal(const Timelines& state) const {
    return std::ranges::all_of(
        request_.goals, [&](const Goal& goal) { return evaluate(goal.achieved, state) == Truth::yes; });
  }

  void expand(std::size_t index) {
    ++expanded_;
    for (const Task& task : model_.tasks) {
      const Node node = nodes_[index];
      const bool ready =
          std::ranges::all_of(task.needs, [&](const Held& held) { return holds(held, node.state); }) &&
          std::ranges::all_of(task.uses, [&](const Drawn& drawn) {
            return number(drawn.timeline, node.state) >= drawn.amount;
          });
      if (!ready) continue;
      Node next{node.state, node.time + task.duration, index, &task};
      for (const Drawn& drawn : task.uses)
        next.state[drawn.timeline] = number(drawn.timeline, node.state) - drawn.amount;
      for (const Held& held : task.sets) next.state[held.timeline] = temporal::state(held.value);
      if (next.time > latest()) {
        too_late_ = true;
        continue;
      }
      const auto [known, fresh] = best_.try_emplace(key_of(next.state), next.time);
      if (!fresh && known->second <= next.time) continue;
      known->second = next.time;
      open_.push({next.time, nodes_.size()});
      nodes_.push_back(std::move(next));
    }
  }

  // By when the plan must be over.
  Duration latest() const {
    Duration latest = temporal::no_bound;
    for (const Goal& goal : request_.goals)
      if (temporal::bounded(goal.closes)) latest = std::min(latest, goal.closes - request_.origin);
    return latest;
  }

  Answer solved(std::size_t index) const {
    std::vector<const Task*> tasks;
    for (; nodes_[index].task != nullptr; index = nodes_[index].parent) tasks.push_back(nodes_[index].task);
    std::ranges::reverse(tasks);
    Answer out;
    out.verdict = Verdict::solved;
    temporal::FlexiblePlan& plan = out.plan.emplace();
    plan.engine = request_.engine;
    plan.origin = request_.origin;
    plan.function_values = uses_;
    for (const Task* task : tasks) add_activity(*task, plan);
    if (temporal::bounded(latest()) && !plan.activities.empty())
      plan.constraints.push_back({temporal::origin_point, plan.activities.back().end_point,
                                  temporal::ConstraintKind::window, Duration{0}, latest()});
    name_goals(plan);
    return out;
  }

  void add_activity(const Task& task, temporal::FlexiblePlan& plan) const {
    temporal::PlanActivity activity =
        activity_of(task, "s" + std::to_string(plan.activities.size() + 1) + "-" + task.name, request_.robot,
                    plan.point_count);
    plan.point_count += 2;
    if (!plan.activities.empty())
      plan.constraints.push_back({plan.activities.back().end_point, activity.start_point,
                                  temporal::ConstraintKind::ordering, Duration{0}, temporal::no_bound});
    plan.activities.push_back(std::move(activity));
  }

  // Backwards along causal links: who sets what a goal or a later task needs.
  void name_goals(temporal::FlexiblePlan& plan) const {
    for (const Goal& goal : request_.goals) {
      std::set<std::string> wanted;
      for (const std::string& timeline : temporal::timelines_of(goal.achieved)) wanted.insert(timeline);
      for (auto activity = plan.activities.rbegin(); activity != plan.activities.rend(); ++activity) {
        const Task& task = *model_.task(activity->name);
        const bool serves =
            std::ranges::any_of(task.sets, [&](const Held& held) { return wanted.contains(held.timeline); });
        if (!serves) continue;
        activity->goals_served.push_back(goal.key());
        for (const Held& held : task.sets) wanted.erase(held.timeline);
        for (const Held& held : task.needs) wanted.insert(held.timeline);
      }
    }
  }

  // Values that timelines can ever take if nothing is undone.
  std::map<std::string, std::set<std::string>> reachable() const {
    std::map<std::string, std::set<std::string>> values;
    for (const auto& [timeline, value] : request_.state)
      if (const auto* state = std::get_if<temporal::State>(&value)) values[timeline].insert(state->name);
    for (bool grows = true; grows;) {
      grows = false;
      for (const Task& task : model_.tasks) {
        const bool possible =
            std::ranges::all_of(task.needs,
                                [&](const Held& held) {
                                  const auto found = values.find(held.timeline);
                                  return found != values.end() && found->second.contains(held.value);
                                }) &&
            std::ranges::all_of(task.uses, [&](const Drawn& drawn) {
              return number(drawn.timeline, request_.state) >= drawn.amount;
            });
        if (!possible) continue;
        for (const Held& held : task.sets) grows |= values[held.timeline].insert(held.value).second;
      }
    }
    return values;
  }

  // A task that would set the value, if its number sufficed.
  const Drawn* shortage(const std::map<std::string, std::set<std::string>>& values) const {
    for (const Task& task : model_.tasks)
      for (const Drawn& drawn : task.uses)
        if (number(drawn.timeline, request_.state) < drawn.amount &&
            std::ranges::any_of(task.sets, [&](const Held& held) {
              const auto found = values.find(held.timeline);
              return found == values.end() || !found->second.contains(held.value);
            }))
          return &drawn;
    return nullptr;
  }

  Answer unsolvable() const {
    Answer out = engine::without_plan(Verdict::unsolvable, "");
    const auto values = reachable();
    for (const Goal& goal : request_.goals) {
      for (const temporal::ConditionNode& node : goal.achieved.nodes) {
        const auto* wanted = std::get_if<temporal::State>(&node.operand);
        if (wanted == nullptr) continue;
        const auto found = values.find(node.timeline);
        if (found != values.end() && found->second.contains(wanted->name)) continue;
        BlockingGoal blocked{goal.issuer, goal.id, node.timeline, "no task makes it " + wanted->name};
        if (const Drawn* drawn = shortage(values)) {
          blocked.timeline = drawn->timeline;
          blocked.reason = "there is too little of it to make " + node.timeline + " " + wanted->name;
        }
        out.blocking.push_back(std::move(blocked));
        break;
      }
    }
    if (out.blocking.empty() && too_late_)
      for (const Goal& goal : request_.goals)
        if (temporal::bounded(goal.closes) && goal.closes - request_.origin == latest())
          out.blocking.push_back(
              {goal.issuer, goal.id, "", "it cannot be achieved before its window closes"});
    out.reason = out.blocking.empty() ? "the goals exclude each other" : "goals are out of reach";
    return out;
  }

  Answer finish(Answer answer) const {
    answer.statistics.expanded = answer.statistics.evaluated = expanded_;
    return answer;
  }

  const Request& request_;
  const Limits& limits_;
  TaskModel model_;
  std::vector<temporal::FunctionValueUse> uses_;
  std::vector<Node> nodes_;
  std::priority_queue<std::pair<Duration, std::size_t>, std::vector<std::pair<Duration, std::size_t>>,
                      std::greater<>>
      open_;
  std::map<std::string, Duration> best_;
  std::uint64_t expanded_ = 0;
  bool too_late_ = false;
};

}  // namespace

Answer SearchEngine::answer(const Request& request, const Limits& limits, FunctionSource& functions) {
  try {
    Search search(request, limits, read_model(request.model));
    if (auto failed = search.ask_durations(functions)) return *failed;
    Answer answer = search.run();
    answer.record = {{".model", request.model}};
    return answer;
  } catch (const ModelError& error) {
    return engine::without_plan(Verdict::invalid_input, error.what());
  }
}

}  // namespace roci::planner::proof
