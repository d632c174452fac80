#include "planner_svc/timeline_htn/checking/check.hpp"

#include <algorithm>

#include "core/temporal/timeline_form.hpp"
#include "planner_svc/timeline_htn/checking/parts.hpp"

namespace roci::planner::timeline_htn::checking {

namespace {

void check_goals_served(const Version& version, Faults& out) {
  const std::vector<model::Goal>& goals = version.model.problem->goals;
  for (const Part& part : version.parts)
    for (const std::string& served : part.activity->goals_served) {
      const auto goal = std::ranges::find(goals, served, &model::Goal::id);
      if (goal == goals.end())
        out.push_back(version.text(part) + " serves '" + served + "', and the problem has no such goal");
      else if (version.network.between(temporal::origin_point, part.start()).lower < goal->release)
        out.push_back(version.text(part) + " serves '" + served + "' and may start before " +
                      to_text(goal->release) + ", when that goal is released");
    }
}

}  // namespace

std::vector<std::string> faults(const model::Model& model, const temporal::FlexiblePlan& plan) {
  if (!model.problem) return {"the model has no problem, so no plan can be an answer to it"};
  Faults out = temporal::check(plan);
  if (!out.empty()) return out;
  out = temporal::timeline_faults(plan, model.problem->horizon);
  if (!out.empty()) return out;
  Version version = take_apart(model, plan, out);
  if (!out.empty()) return out;
  check_timelines(version, out);
  check_needs(version, out);
  check_conditions(version, out);
  check_goals_served(version, out);
  Decompositions decompositions = decompose(version, out);
  check_triggers(version, decompositions, out);
  check_mending(version, out);
  check_decisions(version, decompositions, out);
  if (!out.empty()) return out;
  for (const Schedule& schedule : schedules(version)) {
    execute(version, schedule, decompositions, out);
    if (!out.empty()) return out;
  }
  return out;
}

}  // namespace roci::planner::timeline_htn::checking
