#include "tests/unit/planner_svc/temporal_pddl/validate/oracle.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

double time_of(const std::string& violation) { return std::stod(violation.substr(violation.find('@') + 1)); }

// Once happenings have interfered, their order decides what the state is, and nothing says what the order is:
// what comes later, and invariants at that moment, may differ.
std::set<std::string> comparable(const std::set<std::string>& violations) {
  double first = 1e9;
  for (const std::string& violation : violations) {
    if (violation.starts_with("interference")) first = std::min(first, time_of(violation));
  }
  std::set<std::string> kept;
  for (const std::string& violation : violations) {
    const bool at_once = !violation.starts_with("invariant") && !violation.starts_with("goal");
    if (time_of(violation) < first || (time_of(violation) == first && at_once)) kept.insert(violation);
  }
  return kept;
}

std::set<std::string> violations_of(const Report& report) {
  std::set<std::string> all;
  for (const Violation& violation : report.violations) {
    std::string kind(to_string(violation.kind));
    all.insert(kind + "@" + pddl::print_seconds(violation.time));
  }
  return all;
}

TEST(Oracle, AgreesOnRandomPlans) {
  static constexpr int kEpsilon = 2;  // milliseconds
  std::mt19937_64 random(20240229);
  std::map<std::string, int> seen;
  static constexpr int kCases = 6000;
  for (int i = 0; i < kCases; ++i) {
    const SmallCase small = random_case(random);
    const World world = {domain_sections(small), problem_sections(small), ""};
    Options options;
    options.epsilon = pddl::Microseconds(1000 * kEpsilon);
    const Report report = check_plan(world, plan_text(small), options);
    const auto expected = comparable(judge(small, kEpsilon));
    ASSERT_EQ(comparable(violations_of(report)), expected) << "case " << i << "\n"
                                                           << world.domain << "\n"
                                                           << world.problem << "\n"
                                                           << plan_text(small);
    EXPECT_EQ(report.valid, expected.empty());
    if (expected.empty()) ++seen["valid"];
    for (const std::string& violation : expected) ++seen[violation.substr(0, violation.find('@'))];
  }
  for (const char* kind : {"valid", "condition", "invariant", "interference", "goal", "time"}) {
    EXPECT_GT(seen[kind], kCases / 50) << "too few of " << kind;
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
