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

// Rows and states are found by what is observed: all that could be are 10,000 to the power of eight.
TEST(TimelineCheckerSeam, ManyObjectsCostNoMoreThanWhatIsObservedOfThem) {
  std::string objects;
  for (int i = 0; i < 10'000; ++i) objects += (i == 0 ? "o" : ", o") + std::to_string(i);
  std::string eight = "a: thing", types = "thing", terms = "a";
  for (const char* name : {"b", "c", "d", "e", "f", "g", "h"}) {
    eight += ", " + std::string(name) + ": thing";
    types += ", thing";
    terms += ", " + std::string(name);
  }
  engine::Request many;
  many.model = "format: 1\ndomain: many\ntypes: [thing, other]\nobjects: {thing: [" + objects +
               "]}\nrelations:\n  seen: {arguments: [" + types +
               "], observed: {timeline: way, value: open}}\n"
               "  pair: {arguments: [other, thing], observed: {timeline: two, value: open}}\n"
               "components:\n  one:\n    layer: primitive\n    states:\n"
               "      off: {kind: default, observed: {timeline: state}}\n"
               "      on: {kind: default, parameters: {" +
               eight + "}, observed: {timeline: state, value: \"on(h, " + terms +
               ")\"}}\n    transitions: [\"off <-> on(" + terms + ")\"]\n" +
               "problem: {horizon_s: 100, initial: {}, goals: {}}\n";
  many.objects = {{"x.y", "other", {}}};
  many.state = {{"way.o1.o2.o3.o4.o5.o6.o7.o9999", temporal::state("open")},
                {"way.o1.o2.o3.o4.o5.o6.o7", temporal::state("open")},
                {"way.o1.o2.o3.o4.o5.o6.o7.o8", temporal::state("closed")},
                {"two.x.y.o3", temporal::state("open")},
                {"two.o3.x.y", temporal::state("open")},
                {"state", temporal::state("on", {"o9", "o1", "o2", "o3", "o4", "o5", "o6", "o8", "o9"})}};
  engine::Goal goal;
  goal.id = "g";
  goal.achieved = temporal::compare("one", temporal::ConditionOp::eq,
                                    temporal::state("on", {"o9", "o9", "o9", "o9", "o9", "o9", "o9", "o9"}));
  many.goals = {goal};
  std::vector<std::string> faults;
  const auto model = model_of(many, faults);
  ASSERT_THAT(faults, IsEmpty());
  using Rows = std::vector<std::vector<model::Index>>;
  EXPECT_EQ(model->relations[0].rows, (Rows{{1, 2, 3, 4, 5, 6, 7, 9999}}));
  EXPECT_EQ(model->relations[1].rows, (Rows{{10'000, 3}}));
  EXPECT_EQ(to_text(*model, *model->problem->initial[0], {}), "one.on(o1, o2, o3, o4, o5, o6, o8, o9)");
  EXPECT_EQ(to_text(*model, model->problem->goals.at(0).state, {}), "one.on(o9, o9, o9, o9, o9, o9, o9, o9)");
  many.state["state"] = temporal::state("on", {"o8", "o1", "o2", "o3", "o4", "o5", "o6", "o8", "o9"});
  EXPECT_FALSE(model_of(many, faults)) << "h cannot be two things";
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
