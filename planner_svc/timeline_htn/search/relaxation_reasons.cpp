// Why there is no plan: the first condition, need, part or transition that is never met, in words.
#include <algorithm>

#include "planner_svc/timeline_htn/search/relaxation.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour;

namespace {

constexpr std::size_t kNamed = 3;  // states that a reason names

}  // namespace

// The first that is never met, of what is triggered and of the goals.
std::optional<NeverReached> Relaxation::unmet() {
  explained_.clear();
  for (std::size_t cause = 0; cause < causes_; ++cause)
    if (!tasks_[cause].done) return NeverReached{kNone, reason_of(tasks_[cause])};
  for (const Index g : goal_order(*model_.problem)) {
    const StateId state = ground_.find(ground_of(model_.problem->goals[g].state, {}));
    if (!is_done(state, 0)) return NeverReached{g, reason_of(state, 0)};
  }
  return std::nullopt;
}

std::string Relaxation::only_comes_to(Index component) const {
  const auto& reached = timelines_[component].reached;
  std::string out;
  for (std::size_t i = 0; i < std::min(kNamed, reached.size()); ++i)
    out += (i == 0 ? "" : ", ") + ground_.text(reached[i]);
  if (reached.size() > kNamed) out += " and " + std::to_string(reached.size() - kNamed) + " more";
  return "that timeline comes to " + out + " alone";
}

std::string Relaxation::reason_of(const Task& task) {
  const std::string wanted = task.state == kNone ? "the plan" : ground_.text(task.state);
  std::string out;
  for (const Way& way : task.ways) {
    const Behaviour& behaviour = model_.behaviours[way.behaviour];
    const std::string asks = "behaviour '" + behaviour.name + "' for " + wanted + " asks for ";
    for (const model::Precondition& condition : behaviour.conditions)
      if (!fits(condition, way.objects))
        return asks + (condition.negated ? "not " : "") +
               to_text(model_, ground_of(condition.state, way.objects)) + ", and " +
               only_comes_to(condition.state.component);
    for (const StateId part : way.parts)
      if (out.empty() && !is_done(part, below(task))) out = reason_of(part, below(task));
  }
  if (out.empty()) out = "no behaviour achieves " + wanted + " with these objects";
  return out;
}

std::string Relaxation::reason_of(StateId state, ComponentSet above) {
  if (!explained_.emplace(state, above).second) return "";
  const auto task = task_of_.find({state, above});
  if (task != task_of_.end() && tasks_[task->second].known) return reason_of(tasks_[task->second]);
  if (const model::Need* need = is_complex(state) ? nullptr : unmet_need(state))
    return ground_.text(state) + " needs " +
           to_text(model_, need->state, scope_of(ground_.definition(state))) + ", and " +
           only_comes_to(need->state.component);
  for (const StateId before : graph(component(state)).states()) {
    if (!ground_.may_follow(before, state)) continue;
    for (const auto& [key, index] : task_of_) {
      if (key.first != before || tasks_[index].done || explained_.contains(key)) continue;
      if (const std::string out = reason_of(before, key.second); !out.empty()) return out;
    }
  }
  return "no transitions lead to " + ground_.text(state) + ", and " + only_comes_to(component(state));
}

std::vector<model::Variable> Relaxation::scope_of(const model::State& state) {
  std::vector<model::Variable> out = state.parameters;
  out.insert(out.end(), state.free.begin(), state.free.end());
  return out;
}

}  // namespace roci::planner::timeline_htn::search
