#include "exec_svc/problem/problem_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/pddl/check.hpp"
#include "core/pddl/parser.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {

using beliefs::Beliefs;
using goals::GoalRequest;
using goals::GoalSet;
using goals::GoalState;
using mission::MissionModel;
using problem::Problem;
using problem::ProblemObject;
using problem::write_problem;

namespace {

using temporal::seconds;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::photo;

class ProblemWriterTest : public ::testing::Test {
 protected:
  Problem write(double now_s = 0) {
    return write_problem(mission, beliefs, goals, "p-1", seconds(now_s), seconds(now_s + 5));
  }
  void submit(const GoalRequest& goal) {
    ASSERT_EQ(goals.submit(goal, seconds(0)).record->state, GoalState::pending);
  }

  MissionModel mission = testing::planetary();
  Beliefs beliefs = testing::standing_beliefs(mission);
  GoalSet goals{mission};
};

TEST_F(ProblemWriterTest, StateComesFromObservations) {
  submit(photo("ridge"));
  const Problem problem = write();
  EXPECT_THAT(problem.text, HasSubstr("(:domain planetary)"));
  EXPECT_THAT(problem.text, HasSubstr("(at here)"));
  EXPECT_THAT(problem.text, HasSubstr("(arm-at stow)"));
  EXPECT_THAT(problem.text, HasSubstr("(= (battery) 900000)"));
  EXPECT_THAT(problem.text, HasSubstr("(target image-ridge place-ridge)"));
  EXPECT_THAT(problem.text, HasSubstr("(sent image-ridge)"));
  EXPECT_THAT(problem.text, Not(HasSubstr("arm-here")));
}

TEST_F(ProblemWriterTest, PassesTheProjectsOwnParser) {
  submit(photo("ridge"));
  EXPECT_NO_THROW(pddl::parse_problem(write().text, "problem"));
  EXPECT_NO_THROW(pddl::parse_domain(mission.model_text, "domain"));
}

TEST_F(ProblemWriterTest, ObjectsCarryTheirPlaces) {
  submit(photo("ridge"));
  const Problem problem = write();
  const auto place = std::find_if(problem.objects.begin(), problem.objects.end(),
                                  [](const ProblemObject& object) { return object.name == "place-ridge"; });
  ASSERT_NE(place, problem.objects.end());
  EXPECT_EQ(place->type, "location");
  EXPECT_EQ(place->properties, (std::vector<temporal::Property>{{"x", "110"}, {"y", "60"}}));
}

TEST_F(ProblemWriterTest, WindowsAreRelativeToTheOrigin) {
  submit(photo("ridge"));
  EXPECT_THAT(write(0).text, HasSubstr("(at 1495 (comm-window))"));
  EXPECT_THAT(write(0).text, HasSubstr("(at 2695 (not (comm-window)))"));
  beliefs.observe("comm.window", true);
  EXPECT_THAT(write(2000).text, HasSubstr("    (comm-window)\n"));
  EXPECT_THAT(write(2000).text, HasSubstr("(at 695 (not (comm-window)))"));
}

TEST_F(ProblemWriterTest, AWindowThatShouldBeOpenAndIsNotIsLeftOut) {
  submit(photo("ridge"));
  EXPECT_THAT(write(2000).text, Not(HasSubstr("    (comm-window)\n")));
  EXPECT_THAT(write(1498).text,
              HasSubstr("    (comm-window)\n"));  // opens between the request and the origin
}

TEST_F(ProblemWriterTest, GoalWindowsBecomeTimedLiterals) {
  GoalRequest goal = photo("ridge");
  goal.opens = seconds(100);
  goal.closes = seconds(200);
  submit(goal);
  EXPECT_THAT(write().text, HasSubstr("(at 95 (available image-ridge))"));
  EXPECT_THAT(write().text, HasSubstr("(at 195 (not (available image-ridge)))"));
}

TEST_F(ProblemWriterTest, AchievedGoalsLeaveTheProblemUnlessTheRobotStandsThere) {
  submit(photo("ridge"));
  submit(photo("valley"));
  goals.set_state({"ground", "ridge"}, GoalState::achieved, "observed");
  EXPECT_THAT(write().text, Not(HasSubstr("ridge")));
  beliefs.observe("rover.nav", temporal::state("idle-at", {"place-ridge"}));
  EXPECT_THAT(write().text, HasSubstr("(at place-ridge)"));
  EXPECT_THAT(write().text, Not(HasSubstr("image-ridge")));
}

// The robot stands where it was sent for a goal that is no more: its place is still a place.
TEST_F(ProblemWriterTest, PlacesOfGoalsGivenUpStayKnown) {
  submit(photo("ridge"));
  submit(photo("valley"));
  beliefs.observe("rover.nav", temporal::state("idle-at", {"place-ridge"}));
  for (const GoalState state : {GoalState::recalled, GoalState::dropped, GoalState::failed}) {
    goals.set_state({"ground", "ridge"}, state, "given up");
    EXPECT_THAT(write().text, HasSubstr("    place-ridge - location\n"));
    EXPECT_THAT(write().text, HasSubstr("    (at place-ridge)\n"));
    EXPECT_THAT(write().text, Not(HasSubstr("image-ridge")));
  }
}

TEST_F(ProblemWriterTest, AssumedFactsOfGoalsGivenUpGoWithThem) {
  submit(photo("ridge"));
  GoalRequest pick = photo("soil");
  pick.kind = "pick_sample";
  submit(pick);
  beliefs.assume("rover.sample.sample-soil", {"(sample-at sample-soil place-soil)"});
  goals.set_state({"ground", "soil"}, GoalState::recalled, "given up");
  EXPECT_THAT(write().text, Not(HasSubstr("soil")));
}

TEST_F(ProblemWriterTest, AssumedFactsEndWithTheFirstObservation) {
  GoalRequest pick = photo("soil");
  pick.kind = "pick_sample";
  submit(pick);
  beliefs.assume("rover.sample.sample-soil", {"(sample-at sample-soil place-soil)"});
  EXPECT_THAT(write().text, HasSubstr("(sample-at sample-soil place-soil)"));
  beliefs.observe("rover.sample.sample-soil", temporal::state("held"));
  EXPECT_THAT(write().text, Not(HasSubstr("(sample-at")));
  EXPECT_THAT(write().text, HasSubstr("(picked sample-soil)"));
}

// An image of a goal that has not come yet, or of nobody's.
TEST_F(ProblemWriterTest, AFactOfAnUnknownObjectIsLeftOutAndNamed) {
  submit(photo("ridge"));
  beliefs.observe("rover.image.image-ghost", temporal::state("stored"));
  beliefs.observe("rover.nav", temporal::state("idle-at", {"stow"}));  // a pose is no place
  const Problem problem = write();
  EXPECT_THAT(problem.text, Not(HasSubstr("ghost")));
  EXPECT_THAT(problem.text, Not(HasSubstr("(at stow)")));
  EXPECT_THAT(problem.text, HasSubstr("(arm-at stow)"));
  EXPECT_THAT(problem.text, HasSubstr("(target image-ridge place-ridge)"));
  EXPECT_NO_THROW(pddl::load_problem(problem.text, "problem", *mission.domain));
  ASSERT_EQ(problem.left_out.size(), 2U);
  EXPECT_EQ(problem.left_out[0].part, "(at stow)");
  EXPECT_EQ(problem.left_out[1].part, "(have-image image-ghost)");
  EXPECT_THAT(problem.left_out[1].why, HasSubstr("image-ghost"));
  EXPECT_TRUE(problem.unusable_goals.empty());
  submit(photo("ghost"));
  beliefs.observe("rover.nav", temporal::state("idle-at", {"here"}));
  EXPECT_THAT(write().text, HasSubstr("(have-image image-ghost)"));
  EXPECT_TRUE(write().left_out.empty());
}

TEST_F(ProblemWriterTest, AGoalThatMakesTheProblemInvalidIsNamed) {
  submit(photo("ridge"));
  mission.goal_kinds["photo-of-nothing"] = mission.goal_kinds.at("photo");
  mission.goal_kinds["photo-of-nothing"].goal = {"(sent nobody)"};
  GoalRequest bad = photo("valley");
  bad.kind = "photo-of-nothing";
  submit(bad);
  const Problem problem = write();
  ASSERT_EQ(problem.unusable_goals.size(), 1U);
  EXPECT_EQ(problem.unusable_goals[0].key.id, "valley");
  EXPECT_THAT(problem.unusable_goals[0].why, HasSubstr("nobody"));
}

}  // namespace
}  // namespace roci::exec
