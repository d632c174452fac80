// roci-plan: what it prints where, and that it prints no plan that the validator refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner_svc/temporal_pddl/cli/checked_result.hpp"
#include "planner_svc/temporal_pddl/cli/gantt.hpp"
#include "planner_svc/temporal_pddl/cli/progress_line.hpp"
#include "tests/unit/planner_svc/temporal_pddl/cli/roci_plan_program.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl::cli {
namespace {

using temporal::Verdict;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kDomain =
    R"((:requirements :typing :durative-actions :numeric-fluents) (:types robot site)
    (:predicates (at ?r - robot ?s - site) (sent ?s - site)) (:functions (fuel))
    (:durative-action drive :parameters (?r - robot ?a ?b - site) :duration (= ?duration 5)
      :condition (and (at start (at ?r ?a)) (at start (>= (fuel) 1)))
      :effect (and (at start (not (at ?r ?a))) (at end (at ?r ?b))))
    (:durative-action send :parameters (?r - robot ?s - site) :duration (= ?duration 2)
      :condition (over all (at ?r ?s)) :effect (at end (sent ?s))))";
constexpr const char* kObjects = "(:objects r q - robot a b - site) (:init (at r a) (at q b)";
constexpr const char* kGoal = ") (:goal (and (at r b) (sent b) (sent a)))";

testing::Model model() { return testing::model(kDomain, std::string(kObjects) + "(= (fuel) 3)" + kGoal); }

TEST(CheckedResult, ASoundPlanStays) {
  const auto made = model();
  Result result = testing::solved(made);
  check(made.domain, made.problem, result);
  EXPECT_EQ(result.verdict, Verdict::solved);
  EXPECT_TRUE(result.plan);
}

TEST(CheckedResult, APlanThatTheValidatorRefusesIsNotGivenOut) {
  const auto made = model();
  Result result = testing::solved(made);
  ASSERT_TRUE(result.plan);
  result.plan->activities.back().end += temporal::Duration(1'000'000);
  check(made.domain, made.problem, result);
  EXPECT_EQ(result.verdict, Verdict::crashed);
  EXPECT_FALSE(result.plan);
  EXPECT_THAT(result.reason, HasSubstr("a plan was found that the validator refuses"));
  EXPECT_THAT(result.reason, HasSubstr("against (= ?duration"));
}

TEST(Gantt, HasALaneForEachRobotAndABarForEachActivity) {
  const Result result = testing::solved(model());
  ASSERT_TRUE(result.plan);
  const std::string picture = to_svg(*result.plan, "problem <1>");
  EXPECT_THAT(picture, StartsWith("<svg xmlns"));
  EXPECT_THAT(picture, HasSubstr("problem &lt;1>"));
  for (const char* lane : {">r</text>", ">q</text>", "<title>drive r a b: "})
    EXPECT_THAT(picture, HasSubstr(lane));
}

TEST(ProgressLine, TellsWhatItIsDoingAndFitsTheTerminal) {
  call::Progress progress;
  progress.phase = "searching: lookahead";
  progress.evaluated = 1234;
  EXPECT_EQ(progress_text(progress, 12.7, 87, 80), "12 s  searching: lookahead  1234 evaluated  87 MB");
  progress.has_plan = true;
  progress.makespan = temporal::Duration(45'000'000);
  progress.metric = 7;
  EXPECT_EQ(progress_text(progress, 1, 0, 200),
            "1 s  searching: lookahead  1234 evaluated  best plan 45.000 s, metric 7");
  EXPECT_EQ(progress_text(progress, 1, 0, 20).size(), 20u);
}

class Program : public testing::RociPlanProgram {
 protected:
  void SetUp() override {
    RociPlanProgram::SetUp();
    write("domain", std::string("(define (domain d) ") + kDomain + ")");
    write("sound", std::string("(define (problem p) (:domain d) ") + kObjects + "(= (fuel) 3)" + kGoal + ")");
    write("without", std::string("(define (problem p) (:domain d) ") + kObjects + kGoal + ")");
  }
};

TEST_F(Program, ThePlanGoesToStandardOutputAndThePictureIntoItsFile) {
  EXPECT_EQ(run("domain sound --gantt plan.svg"), 0);
  EXPECT_THAT(read("out"), HasSubstr("(drive r a b) [5.000]"));
  EXPECT_THAT(read("err"), IsEmpty());
  EXPECT_THAT(read("plan.svg"), StartsWith("<svg"));
}

TEST_F(Program, WarningsGoToStandardErrorAndIntoTheJson) {
  EXPECT_EQ(run("domain without"), 1);
  EXPECT_THAT(read("out"), IsEmpty());
  EXPECT_THAT(read("err"), StartsWith("without:1:1: warning: (fuel) has no initial value"));
  EXPECT_THAT(read("err"), HasSubstr("\nunsolvable: (drive r ? b) reads (fuel), which has no value"));
  EXPECT_EQ(run("domain without --json"), 1);
  EXPECT_THAT(read("out"), HasSubstr("\"warnings\": [\n    \"without:1:1: warning: (fuel)"));
}

TEST_F(Program, AsksForExactValuesAsItsModeSays) {
  write("ways",
        "(define (domain w) (:requirements :typing :durative-actions) (:types place) (:predicates (at ?p - place))"
        " (:modules (:module roads (:function (time ?a ?b - place)))) (:durative-action go :parameters (?a ?b - "
        "place) :duration (= ?duration (time ?a ?b)) :condition (at start (at ?a)) :effect (and (at start (not (at "
        "?a))) (at end (at ?b)))))");
  write("trip", "(define (problem p) (:domain w) (:objects a b c - place) (:init (at a)) (:goal (at c)))");
  std::string values;
  for (const std::string from : {"a", "b", "c"})
    for (const std::string to : {"a", "b", "c"})
      values += "(time " + from + " " + to + ") 10\n(time " + from + " " + to + ") >= 6\n";
  write("values", values);
  EXPECT_EQ(run("ways trip --functions values --json"), 0);
  EXPECT_THAT(read("out"), HasSubstr("\"exact_values\": 9"));
  EXPECT_EQ(run("ways trip --functions values --functions-mode two-accuracy --json"), 0) << read("err");
  EXPECT_THAT(read("out"), HasSubstr("\"cheap_values\": 9"));
  EXPECT_THAT(read("out"), HasSubstr("\"exact_values\": 1,"));
  EXPECT_THAT(read("out"), HasSubstr("\"duration\": 10.0"));
  EXPECT_EQ(run("ways trip --functions values --functions-mode none"), 64);
  EXPECT_THAT(read("err"), HasSubstr("two-accuracy"));
}

// R30: a whole action is two steps, `ring` is one. What a step costs does not grow with the plan before it.
TEST_F(Program, APlanHas32767StepsAndNotOneMore) {
  write("clock",
        "(define (domain clock) (:requirements :durative-actions :numeric-fluents) (:predicates (idle) (rung))"
        " (:functions (ticks)) (:durative-action tick :parameters () :duration (= ?duration 1)"
        " :condition (at start (idle)) :effect (and (at start (not (idle))) (at end (idle))"
        " (at end (increase (ticks) 1)))) (:action ring :parameters () :precondition (idle) :effect (rung)))");
  const auto goal = [&](const std::string& name, const std::string& wanted) {
    write(name, "(define (problem p) (:domain clock) (:init (idle) (= (ticks) 0)) (:goal " + wanted + "))");
  };
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  goal("one-less", "(>= (ticks) 16383)");
  EXPECT_EQ(run("clock one-less"), 0) << read("err");
  EXPECT_EQ(lines(read("out")), 16'383);
  goal("most", "(and (>= (ticks) 16383) (rung))");
  EXPECT_EQ(run("clock most"), 0) << read("err");
  EXPECT_EQ(lines(read("out")), 16'384);
  goal("one-more", "(>= (ticks) 16384)");
  EXPECT_EQ(run("clock one-more"), 5);
  EXPECT_THAT(read("out"), IsEmpty());
  EXPECT_EQ(read("err"), "out_of_memory: a plan may have at most 32767 steps, and none so short was found\n");
}

TEST_F(Program, AMemoryLimitIsSetWithoutAskingAndIsACleanVerdict) {
  EXPECT_EQ(run("--help"), 0);
  EXPECT_THAT(read("out"), HasSubstr("--memory"));
  EXPECT_THAT(read("out"), HasSubstr("4096 or three quarters of the machine's memory"));
  std::string objects, facts;
  for (int i = 0; i < 200; ++i) {
    objects += " o" + std::to_string(i);
    facts += " (q o" + std::to_string(i) + ")";
  }
  write("wide",
        "(define (domain w) (:predicates (p ?x ?y) (q ?x)) (:action a :parameters (?x ?y) :precondition "
        "(and (q ?x) (q ?y)) :effect (p ?x ?y)))");
  write("many",
        "(define (problem p) (:domain w) (:objects" + objects + ") (:init" + facts + ") (:goal (p o1 o2)))");
  EXPECT_EQ(run("domain sound --memory 4096"), 0);
  EXPECT_EQ(run("wide many --memory 8"), 5) << read("err");
  EXPECT_THAT(read("err"), StartsWith("out_of_memory: "));
  EXPECT_THAT(read("err"), Not(HasSubstr("terminate")));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::cli
