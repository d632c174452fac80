// The checker behind the seam: what a request says of states and goals counts.
#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/unit/planner_svc/timeline_htn/checking/plans.hpp"

namespace roci::planner::timeline_htn::checking {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

std::string text(const std::string& file) {
  std::ifstream in(std::filesystem::path(ROCI_SOURCE_DIR) / "tests/missions/greenhouse" / file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

engine::Request request() {
  engine::Request out;
  out.origin = temporal::seconds(1000);
  out.model = text("domain.yaml") + text("behaviours.yaml");
  const std::string problem = text("problem.yaml");
  const std::string include = "include: [domain.yaml, behaviours.yaml]\n";
  out.problem_text = std::string(problem).erase(problem.find(include), include.size());
  out.state = {{"base.nav", temporal::state("parked", {"well"})}, {"tank.level", temporal::state("full")}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "basil";
  goal.achieved = temporal::compare("care", temporal::ConditionOp::eq, temporal::state("tending", {"basil"}));
  goal.closes = temporal::seconds(1600);
  out.goals = {goal};
  return out;
}

std::vector<std::string> faults_of(const engine::Request& request, const temporal::FlexiblePlan& plan) {
  return TimelineChecker().faults({.request = request, .values = {}, .plan = plan});
}

TEST(TimelineCheckerSeam, TakesStatesAndGoalsFromTheRequest) {
  std::vector<std::string> faults;
  const auto model = model_of(request(), faults);
  ASSERT_THAT(faults, IsEmpty());
  EXPECT_EQ(to_text(*model, *model->problem->initial[1], {}), "base.at(well)");
  EXPECT_EQ(to_text(*model, *model->problem->initial[3], {}), "tank.full");
  EXPECT_EQ(to_text(*model, *model->problem->initial[2], {}), "arm.folded") << "as the model's problem says";
  ASSERT_EQ(model->problem->goals.size(), 1U);
  EXPECT_EQ(model->problem->goals[0].id, "ground/basil");
  EXPECT_EQ(model->problem->goals[0].closes, temporal::seconds(600));
  const temporal::FlexiblePlan plan = plan_for(*model);
  EXPECT_THAT(faults_of(request(), plan), IsEmpty());

  engine::Request other = request();
  other.state["tank.level"] = temporal::state("empty");
  EXPECT_THAT(faults_of(other, plan), Contains(HasSubstr("timeline tank: it begins with tank.full")));
  other = request();
  other.goals[0].closes = temporal::seconds(1010);
  EXPECT_THAT(faults_of(other, plan), Contains(HasSubstr("goal 'ground/basil'")));
}

TEST(TimelineCheckerSeam, TakesWhatIsObservedWhereTheModelSaysNothing) {
  engine::Request seen = request();
  const std::string initial = "base: at(dock), ";
  seen.problem_text.erase(seen.problem_text.find(initial), initial.size());
  std::vector<std::string> faults;
  EXPECT_TRUE(model_of(seen, faults));
  EXPECT_THAT(faults, IsEmpty());
  seen.state.erase("base.nav");
  EXPECT_FALSE(model_of(seen, faults));
  EXPECT_THAT(faults,
              Contains(HasSubstr("neither the request nor the model says in which state 'base' begins")));
}

TEST(TimelineCheckerSeam, SaysWhatItCannotCheckAgainst) {
  engine::Request bad = request();
  bad.goals[0].achieved =
      temporal::compare("care", temporal::ConditionOp::eq, temporal::state("tending", {"rose"}));
  EXPECT_THAT(faults_of(bad, {}), Contains(HasSubstr("goal 'ground/basil' asks for no state of the model")));
  bad = request();
  bad.model += "nonsense: 1\n";
  EXPECT_THAT(faults_of(bad, {}), Contains(HasSubstr("unknown key 'nonsense'")));
  bad = request();
  bad.problem_text.clear();
  EXPECT_THAT(faults_of(bad, {}), Contains(HasSubstr("asks for no state")));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::checking
