#include "exec_svc/mission/observed_names.hpp"

#include <map>
#include <string>
#include <utility>

namespace roci::exec::mission {
namespace {

class ObservedNames {
 public:
  explicit ObservedNames(const MissionModel& mission) {
    for (const FluentSource& source : mission.fluents)
      if (source.timeline) timeline_of_[source.fluent] = *source.timeline;
    for (const WindowModel& window : mission.windows)
      if (!window.fact.empty() && !window.timeline.empty()) timeline_of_[window.fact] = window.timeline;
  }

  void put_in(std::string& name) const {
    if (const auto known = timeline_of_.find(name); known != timeline_of_.end()) name = known->second;
  }

  void put_in(temporal::Condition& condition) const {
    for (temporal::ConditionNode& node : condition.nodes) put_in(node.timeline);
  }

 private:
  std::map<std::string, std::string> timeline_of_;
};

}  // namespace

temporal::FlexiblePlan with_observed_names(temporal::FlexiblePlan plan, const MissionModel& mission) {
  const ObservedNames names(mission);
  for (temporal::PlanActivity& activity : plan.activities) {
    for (temporal::Condition* condition :
         {&activity.pre, &activity.maintenance, &activity.post, &activity.skip_if})
      names.put_in(*condition);
    for (temporal::Impact& impact : activity.impacts) names.put_in(impact.timeline);
  }
  for (temporal::Token& token : plan.tokens) names.put_in(token.timeline);
  for (temporal::DecisionPoint& decision : plan.decisions)
    for (temporal::DecisionChoice& choice : decision.choices) names.put_in(choice.rule);
  return plan;
}

}  // namespace roci::exec::mission
