#include "core/pddl/plan_text.hpp"

#include <cmath>

#include "core/pddl/line_scanner.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

namespace {

Microseconds expect_time(LineScanner& scanner, std::string_view what) {
  static constexpr double kLatest = 1e9;  // seconds; to there doubles are exact to the microsecond
  scanner.at_end();                       // so that here() is the number
  const SourceLocation where = scanner.here();
  const double seconds = scanner.expect_number(what);
  if (seconds < 0 || seconds > kLatest) {
    scanner.fail(where, std::string(what) + " is out of range", "0 to 1000000000 seconds");
  }
  return Microseconds(std::llround(seconds * 1e6));
}

PlanStep read_step(LineScanner& scanner) {
  static constexpr std::string_view kForm = "write TIME: (ACTION OBJECT …) [DURATION]";
  PlanStep step;
  step.where = scanner.here();
  step.start = expect_time(scanner, "a start time");
  scanner.expect(':', kForm);
  step.action = scanner.expect_ground_atom("an action");
  if (scanner.take('[')) {
    step.duration = expect_time(scanner, "a duration");
    scanner.expect(']', kForm);
  }
  scanner.expect_end(kForm);
  return step;
}

}  // namespace

std::vector<PlanStep> parse_plan(std::string_view text, std::string_view file) {
  std::vector<PlanStep> plan;
  for_each_line(text, file, [&](LineScanner& scanner) { plan.push_back(read_step(scanner)); });
  return plan;
}

std::string print_seconds(Microseconds time) {
  std::string digits = std::to_string(std::abs(time.count()));
  if (digits.size() < 7) digits.insert(0, 7 - digits.size(), '0');
  const std::size_t point = digits.size() - 6;
  std::size_t end = digits.size();
  while (end > point + 3 && digits[end - 1] == '0') --end;
  return (time.count() < 0 ? "-" : "") + digits.substr(0, point) + "." + digits.substr(point, end - point);
}

std::string print_plan(const std::vector<PlanStep>& plan) {
  std::string text;
  for (const PlanStep& step : plan) {
    text += print_seconds(step.start) + ": " + print(step.action);
    if (step.duration) text += " [" + print_seconds(*step.duration) + "]";
    text += "\n";
  }
  return text;
}

}  // namespace roci::pddl
