// Goals that are more than an observed fact: derived, negated, alternatives, numbers. Planner and executive agree on
// when they hold.
#include "exec_svc/mission/goal_formula.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/mission/entry.hpp"
#include "exec_svc/mission/domain_names.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {
namespace {

namespace fs = std::filesystem;
using mission::MissionModel;
using temporal::state;
using ::testing::HasSubstr;

std::string text_of(const fs::path& file) {
  std::ostringstream out;
  out << std::ifstream(file).rdbuf();
  return out.str();
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

// The planetary mission with derived predicates and another goal of a photo.
class GoalFormula : public ::testing::Test {
 protected:
  GoalFormula() { fs::create_directories(folder_); }
  ~GoalFormula() override { fs::remove_all(folder_); }

  MissionModel with_goal(const std::string& goal) {
    const fs::path planetary = ROCI_SOURCE_DIR "/missions/planetary";
    std::string domain = text_of(planetary / "domain.pddl");
    replace(domain, "(:requirements ", "(:requirements :derived-predicates :negative-preconditions ");
    replace(domain, "(comm-window))",
            "(comm-window) (kept ?i - image) (near ?a ?b - location) (linked ?a ?b - location))");
    replace(domain, "(:functions",
            "(:derived (kept ?i - image) (and (have-image ?i) (not (sent ?i))))\n"
            "(:derived (linked ?a ?b - location) (or (near ?a ?b)\n"
            "    (exists (?c - location) (and (near ?a ?c) (linked ?c ?b)))))\n(:functions");
    std::ofstream(folder_ / "domain.pddl") << domain;
    std::string yaml = text_of(planetary / "mission.yaml");
    replace(yaml, "goal: [\"(sent image-{id})\"]", "goal: [\"" + goal + "\"]");
    std::ofstream(folder_ / "mission.yaml") << yaml;
    return mission::read_mission(folder_);
  }

  // Whether the goal of image "a" is seen as achieved, with this state of the image and this battery.
  bool achieved(const std::string& goal, const std::string& image, double battery = 900000) {
    const MissionModel model = with_goal(goal);
    goals::GoalSet goals(model);
    goals.submit(testing::photo("a"), temporal::Time{0});
    beliefs::Beliefs beliefs = testing::standing_beliefs(model);
    if (!image.empty()) beliefs.observe("rover.image.image-a", state(image));
    beliefs.observe("rover.battery", battery);
    return problem::is_achieved(model, beliefs, goals, testing::photo("a"), temporal::Time{0});
  }

  std::string refusal_of(const std::string& goal) {
    try {
      with_goal(goal);
    } catch (const roci::mission::FileError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_ = fs::temp_directory_path() / ("roci_formula_" + std::to_string(::getpid()));
};

TEST_F(GoalFormula, OnADerivedPredicateIsSeenAsAchieved) {
  EXPECT_FALSE(achieved("(kept image-{id})", ""));
  EXPECT_TRUE(achieved("(kept image-{id})", "stored"));
  EXPECT_FALSE(achieved("(kept image-{id})", "sent"));
}

TEST_F(GoalFormula, OnARecursiveDerivedPredicateIsSeenAsAchieved) {
  EXPECT_FALSE(achieved("(linked here place-{id})", ""));
  EXPECT_FALSE(achieved("(or (linked here place-{id}) (sent image-{id}))", "stored"));
  EXPECT_TRUE(achieved("(not (linked here place-{id}))", ""));
}

TEST_F(GoalFormula, MayBeNegatedOrAnAlternative) {
  EXPECT_TRUE(achieved("(not (sent image-{id}))", "stored"));
  EXPECT_FALSE(achieved("(not (sent image-{id}))", "sent"));
  EXPECT_TRUE(achieved("(or (sent image-{id}) (have-image image-{id}))", "stored"));
  EXPECT_FALSE(achieved("(or (sent image-{id}) (have-image image-{id}))", ""));
  EXPECT_TRUE(achieved("(imply (sent image-{id}) (have-image image-{id}))", "sent"));
  EXPECT_TRUE(achieved("(forall (?i - image) (sent ?i))", "sent"));
  EXPECT_FALSE(achieved("(exists (?i - image) (sent ?i))", "stored"));
}

TEST_F(GoalFormula, MayCompareNumbers) {
  EXPECT_TRUE(achieved("(<= (battery) 340000)", "", 340000));
  EXPECT_FALSE(achieved("(<= (battery) 340000)", "", 340001));
  EXPECT_TRUE(achieved("(>= (battery) (+ (reserve) {x}))", "", 20110));
  EXPECT_FALSE(achieved("(>= (battery) (+ (reserve) {x}))", "", 20109));
}

TEST_F(GoalFormula, IsNotAchievedBeforeEverythingWasObserved) {
  const MissionModel model = with_goal("(not (sent image-{id}))");
  goals::GoalSet goals(model);
  goals.submit(testing::photo("a"), temporal::Time{0});
  EXPECT_FALSE(
      problem::is_achieved(model, beliefs::Beliefs(model), goals, testing::photo("a"), temporal::Time{0}));
}

TEST_F(GoalFormula, StandsInTheProblemAndInTheGoalForEngines) {
  const MissionModel model = with_goal("(or (sent image-{id}) (<= (battery) 5))");
  goals::GoalSet goals(model);
  goals.submit(testing::photo("a"), temporal::Time{0});
  const problem::Problem problem = problem::write_problem(model, testing::standing_beliefs(model), goals, "p",
                                                          temporal::Time{0}, temporal::Time{0});
  EXPECT_THAT(problem.text, HasSubstr("(or (sent image-a) (<= (battery) 5))"));
  ASSERT_EQ(problem.goals.size(), 1U);
  EXPECT_EQ(temporal::describe(problem.goals.front().achieved), "(sent image-a) = true or (battery) <= 5");
  EXPECT_TRUE(problem.unusable_goals.empty());
}

TEST_F(GoalFormula, ThatCannotBeReadOrJudgedIsRefusedWhereItStands) {
  EXPECT_THAT(refusal_of("(sent image-{id}"), HasSubstr("mission.yaml:"));
  EXPECT_THAT(refusal_of("(sent image-{id}"), HasSubstr("is no condition of PDDL"));
  EXPECT_THAT(refusal_of("(not (snet image-{id}))"), HasSubstr("the domain has no predicate 'snet'"));
  EXPECT_THAT(refusal_of("(or (sent image-{id}) (sent))"),
              HasSubstr("'sent' has 1 arguments in the domain, not 0"));
  EXPECT_THAT(refusal_of("(>= (batery) 5)"), HasSubstr("the domain has no function 'batery'"));
  EXPECT_THAT(refusal_of("(<= (traverse_time here place-{id}) 5)"),
              HasSubstr("nobody observes 'traverse_time'"));
}

// Nobody could tell when such a goal holds: it is given up with that reason, and the others go on.
TEST_F(GoalFormula, ThatRangesOverTooManyObjectsIsNoGoalForThePlanner) {
  MissionModel model = with_goal("(exists (?a ?b ?c - location) (and (linked ?a ?b) (linked ?b ?c)))");
  for (int i = 0; i < 300; ++i) {
    mission::ObjectModel place;
    place.name = "far-" + std::to_string(i);
    place.type = "location";
    model.objects.push_back(place);
  }
  goals::GoalSet goals(model);
  goals.submit(testing::photo("a"), temporal::Time{0});
  const auto beliefs = testing::standing_beliefs(model);
  const problem::Problem problem =
      problem::write_problem(model, beliefs, goals, "p", temporal::Time{0}, temporal::Time{0});
  ASSERT_EQ(problem.unusable_goals.size(), 1U);
  EXPECT_THAT(problem.unusable_goals.front().why, HasSubstr("derived predicate 'linked' ("));
  EXPECT_THAT(problem.unusable_goals.front().why, HasSubstr("domain.pddl:"));
  EXPECT_THAT(problem.unusable_goals.front().why, HasSubstr(" ranges over too many objects"));
  EXPECT_FALSE(problem::is_achieved(model, beliefs, goals, testing::photo("a"), temporal::Time{0}));
}

TEST_F(GoalFormula, WithTooManyVariablesIsRefusedWhereItStands) {
  std::string variables;
  for (int i = 0; i < 257; ++i) variables += " ?v" + std::to_string(i);
  EXPECT_THAT(
      refusal_of("(forall (" + variables + " - image) (sent ?v0))"),
      ::testing::ContainsRegex("mission.yaml:[0-9]+:[0-9]+: .*has 257 variables, and 256 are supported"));
}

TEST_F(GoalFormula, ADomainWithTooManyVariablesIsRefusedWhereItStands) {
  std::string variables;
  for (int i = 0; i < 257; ++i) variables += " ?v" + std::to_string(i);
  const auto refusal = [](const std::string& rest) -> std::string {
    try {
      mission::read_domain(
          "(define (domain d) (:requirements :derived-predicates :durative-actions)\n" + rest + ")",
          "domain.pddl");
    } catch (const roci::mission::FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(
      refusal("(:predicates (p ?x) (d))\n(:derived (d) (forall (" + variables + ") (p ?v0)))"),
      HasSubstr("domain.pddl:3:11: error: derived predicate 'd' has 257 variables, and 256 are supported"));
  EXPECT_THAT(refusal("(:predicates (p ?x))\n(:action a :parameters (" + variables +
                      ") :precondition (p ?v0) :effect (p ?v1))"),
              HasSubstr("domain.pddl:3:1: error: action 'a' has 257 variables, and 256 are supported"));
}

}  // namespace
}  // namespace roci::exec
