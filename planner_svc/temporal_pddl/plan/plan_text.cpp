#include "planner_svc/temporal_pddl/plan/plan_text.hpp"

namespace roci::planner::temporal_pddl {

std::string seconds_text(Duration duration) {
  constexpr std::int64_t kPerSecond = 1'000'000;
  std::string fraction = std::to_string(kPerSecond + duration.count() % kPerSecond).substr(1);
  if (duration.count() % 1000 == 0) fraction.resize(3);
  return std::to_string(duration.count() / kPerSecond) + "." + fraction;
}

std::string to_ipc(const Plan& plan) {
  std::string text;
  for (const Activity& activity : plan.activities) {
    text += seconds_text(activity.start) + ": (" + activity.name;
    for (const auto& argument : activity.arguments) text += " " + argument;
    text += ")";
    if (activity.durative) text += " [" + seconds_text(activity.end - activity.start) + "]";
    text += "\n";
  }
  return text;
}

}  // namespace roci::planner::temporal_pddl
