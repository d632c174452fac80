#include "planner_svc/validate/report.hpp"

#include <sstream>

namespace roci::validate {

std::string_view to_string(ViolationKind kind) {
  switch (kind) {
    case ViolationKind::kUnknownAction:
      return "unknown action";
    case ViolationKind::kWrongArguments:
      return "wrong arguments";
    case ViolationKind::kTime:
      return "time";
    case ViolationKind::kCondition:
      return "condition";
    case ViolationKind::kInvariant:
      return "invariant";
    case ViolationKind::kInterference:
      return "interference";
    case ViolationKind::kConflictingEffects:
      return "conflicting effects";
    case ViolationKind::kUndefinedValue:
      return "undefined value";
    case ViolationKind::kGoal:
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

}  // namespace roci::validate
