#include "exec_svc/reactor/shortfall.hpp"

#include <map>
#include <optional>

namespace roci::exec {
namespace {

using temporal::Impact;
using temporal::PlanActivity;
using temporal::Value;

using Levels = std::map<std::string, double>;

// The timelines that the plan draws on, as they stand now.
Levels levels_of(const temporal::FlexiblePlan& plan, const temporal::Lookup& now) {
  Levels out;
  for (const PlanActivity& activity : plan.activities) {
    for (const Impact& impact : activity.impacts) {
      if (impact.kind != temporal::ImpactKind::delta || out.contains(impact.timeline)) continue;
      const auto value = now(impact.timeline);
      if (!value) continue;
      if (const double* number = std::get_if<double>(&*value)) out[impact.timeline] = *number;
    }
  }
  return out;
}

void take(const PlanActivity& activity, Levels& levels) {
  for (const Impact& impact : activity.impacts) {
    const auto level = levels.find(impact.timeline);
    const double* amount = std::get_if<double>(&impact.amount);
    if (impact.kind == temporal::ImpactKind::delta && level != levels.end() && amount != nullptr)
      level->second += *amount;
  }
}

}  // namespace

std::string shortfall(const temporal::FlexiblePlan& plan, const std::vector<StepStatus>& steps,
                      const temporal::Lookup& now) {
  Levels levels = levels_of(plan, now);
  if (levels.empty()) return "";
  const auto projected = [&levels](const std::string& timeline) -> std::optional<Value> {
    const auto level = levels.find(timeline);
    return level == levels.end() ? std::nullopt : std::optional<Value>(level->second);
  };
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    if (steps[i].state != temporal::ActivityState::waiting) continue;
    const PlanActivity& activity = plan.activities[i];
    for (const temporal::ConditionNode& node : activity.pre.nodes) {
      const temporal::Condition part{{node}};
      if (levels.contains(node.timeline) && temporal::evaluate(part, projected) == temporal::Truth::no)
        return activity.id + " will lack " + temporal::explain(part, projected);
    }
    take(activity, levels);
  }
  return "";
}

}  // namespace roci::exec
