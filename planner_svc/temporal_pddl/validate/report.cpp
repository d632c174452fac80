#include "planner_svc/temporal_pddl/validate/report.hpp"

#include <sstream>

namespace roci::planner::temporal_pddl::validate {

std::string_view to_string(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::unknown_action:
      return "unknown action";
    case ViolationKind::wrong_arguments:
      return "wrong arguments";
    case ViolationKind::time:
      return "time";
    case ViolationKind::condition:
      return "condition";
    case ViolationKind::invariant:
      return "invariant";
    case ViolationKind::interference:
      return "interference";
    case ViolationKind::conflicting_effects:
      return "conflicting effects";
    case ViolationKind::undefined_value:
      return "undefined value";
    case ViolationKind::goal:
      break;
  }
  return "goal";
}

std::string to_text(const Report& report, const std::vector<pddl::PlanStep>& plan, std::string_view file) {
  std::ostringstream text;
  for (const Violation& violation : report.violations) {
    text << file;
    if (violation.step && plan[*violation.step].where.line > 0)
      text << ':' << plan[*violation.step].where.line;
    text << ": at " << pddl::print_seconds(violation.time) << ": ";
    if (!violation.action.empty()) text << violation.action << ": ";
    text << violation.message << '\n';
  }
  return text.str();
}

}  // namespace roci::planner::temporal_pddl::validate
