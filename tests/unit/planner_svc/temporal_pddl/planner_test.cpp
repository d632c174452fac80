#include "planner_svc/temporal_pddl/planner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>

#include "core/pddl/printer.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options, call::WindowExtraction;
using extraction::Activity, extraction::NetworkPoint;
using temporal::Duration, temporal::Verdict;
using testing::expect_valid, testing::model, testing::solved;

// R10: every plan must mend while a match burns.
TEST(Planner, MatchCellar) {
  const auto made = model(R"(
    (:requirements :typing :durative-actions) (:types match fuse)
    (:predicates (light ?m - match) (handfree) (unused ?m - match) (mended ?f - fuse))
    (:durative-action light-match :parameters (?m - match) :duration (= ?duration 5)
      :condition (at start (unused ?m))
      :effect (and (at start (not (unused ?m))) (at start (light ?m)) (at end (not (light ?m)))))
    (:durative-action mend :parameters (?f - fuse ?m - match) :duration (= ?duration 2)
      :condition (and (at start (handfree)) (over all (light ?m)))
      :effect (and (at start (not (handfree))) (at end (mended ?f)) (at end (handfree)))))",
                          R"((:objects m0 m1 - match f0 f1 f2 f3 - fuse)
    (:init (unused m0) (unused m1) (handfree)) (:goal (and (mended f0) (mended f1) (mended f2) (mended f3))))");
  expect_valid(made, solved(made));
  const auto one_match = model(R"(
    (:requirements :durative-actions) (:predicates (light) (unused) (a) (b))
    (:durative-action light-match :parameters () :duration (= ?duration 5) :condition (at start (unused))
      :effect (and (at start (not (unused))) (at start (light)) (at end (not (light)))))
    (:durative-action do-a :parameters () :duration (= ?duration 3) :condition (over all (light)) :effect (at end (a)))
    (:durative-action do-b :parameters () :duration (= ?duration 6) :condition (over all (light)) :effect (at end (b))))",
                               "(:init (unused)) (:goal (and (a) (b)))");
  EXPECT_EQ(solved(one_match).verdict, Verdict::unsolvable);  // do-b is longer than the match burns
}

// Contents as long as their envelope fit exactly: invariants need no ε (kind 00 of R29).
TEST(Planner, AnInvariantFillsItsEnvelope) {
  const auto made = model(R"(
    (:requirements :durative-actions) (:predicates (light) (g))
    (:durative-action burn :parameters () :duration (= ?duration 5) :condition ()
      :effect (and (at start (light)) (at end (not (light)))))
    (:durative-action work :parameters () :duration (= ?duration 5) :condition (over all (light)) :effect (at end (g))))",
                          "(:init) (:goal (g))");
  expect_valid(made, solved(made));
}

// R12: the goal holds in the middle of an action that must end first, which needs another one.
TEST(Planner, NothingRunsInTheEnd) {
  const auto made = model(R"(
    (:requirements :durative-actions) (:predicates (g) (closed))
    (:durative-action open :parameters () :duration (= ?duration 5) :condition (at end (closed))
      :effect (and (at start (g)) (at end (closed))))
    (:durative-action close :parameters () :duration (= ?duration 1) :condition () :effect (at end (closed))))",
                          "(:init) (:goal (g))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_EQ(result.plan->activities.size(), 2u);
}

// R13: an effect that breaks a running invariant.
TEST(Planner, RunningInvariantsAreKept) {
  const auto made = model(R"(
    (:requirements :durative-actions) (:predicates (quiet) (g) (h))
    (:durative-action measure :parameters () :duration (= ?duration 5) :condition (over all (quiet)) :effect (at end (g)))
    (:durative-action drill :parameters () :duration (= ?duration 1) :condition ()
      :effect (and (at start (not (quiet))) (at end (h)))))",
                          "(:init (quiet)) (:goal (and (g) (h)))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_EQ(result.plan->activities[0].name, "measure");
  EXPECT_EQ(result.plan->activities[1].start, std::chrono::seconds(5));
}

// R2: a duration is chosen within its bounds, here to meet another action's end.
TEST(Planner, FlexibleDurationsStretch) {
  const auto made = model(R"(
    (:requirements :durative-actions :duration-inequalities) (:predicates (on) (done) (g))
    (:durative-action hold :parameters () :duration (and (>= ?duration 2) (<= ?duration 20)) :condition ()
      :effect (and (at start (on)) (at end (not (on)))))
    (:durative-action work :parameters () :duration (= ?duration 7) :condition (over all (on)) :effect (at end (g))))",
                          "(:init) (:goal (g))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_EQ(result.plan->activities[0].name, "hold");
  EXPECT_EQ(result.plan->activities[0].end, std::chrono::seconds(7));
  EXPECT_EQ(result.plan->activities[0].min_duration, std::chrono::seconds(2));
  EXPECT_EQ(result.plan->activities[0].max_duration, std::chrono::seconds(20));
}

// R3: each comparison at each point.
TEST(Planner, NumbersAreConditionsAtAllPoints) {
  struct Case {
    const char* condition;
    bool solvable;
  };
  // x is 2; work needs 4 s and adds 1 to x at its start; tick adds 1 at its end, 1 s after its start
  for (const auto& [condition, solvable] : {Case{"(at start (>= (x) 3))", true},
                                            {"(at start (<= (x) 1))", false},
                                            {"(at start (= (x) 2))", true},
                                            {"(at start (< (x) 2))", false},
                                            {"(at end (>= (x) 4))", true},
                                            {"(at end (= (x) 2))", false},
                                            {"(over all (<= (x) 3))", true},
                                            {"(over all (<= (x) 2))", false},
                                            {"(over all (> (x) 3.5))", true},
                                            {"(at end (< (x) 3))", false}}) {
    const auto made = model(std::string(R"(
      (:requirements :durative-actions :numeric-fluents) (:predicates (g)) (:functions (x))
      (:durative-action work :parameters () :duration (= ?duration 4) :condition )") +
                                condition + R"( :effect (and (at start (increase (x) 1)) (at end (g))))
      (:durative-action tick :parameters () :duration (= ?duration 1) :condition (at start (<= (x) 5))
        :effect (at end (increase (x) 1))))",
                            "(:init (= (x) 2)) (:goal (g))");
    const Result result = solved(made);
    EXPECT_EQ(result.verdict, solvable ? Verdict::solved : Verdict::unsolvable) << condition;
    if (solvable) expect_valid(made, result);
  }
}

// A duration that depends on the state, with an effect that depends on the duration (R1: Rovers Metric Time).
TEST(Planner, ChargesAsLongAsNeeded) {
  const auto made = model(R"(
    (:requirements :durative-actions :numeric-fluents) (:predicates (g)) (:functions (energy) (rate))
    (:durative-action charge :parameters () :duration (= ?duration (/ (- 80 (energy)) (rate)))
      :condition (at start (<= (energy) 80)) :effect (at end (increase (energy) (* ?duration (rate)))))
    (:durative-action work :parameters () :duration (= ?duration 1) :condition (at start (>= (energy) 75))
      :effect (and (at start (decrease (energy) 10)) (at end (g)))))",
                          "(:init (= (energy) 17) (= (rate) 7)) (:goal (g))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_EQ(result.plan->activities[0].end, std::chrono::microseconds(9000000));
}

TEST(Planner, AssignmentsAndScaling) {
  const auto made = model(R"(
    (:requirements :numeric-fluents) (:functions (x) (y)) (:predicates (go))
    (:action double :parameters () :precondition () :effect (scale-up (x) 2))
    (:action copy :parameters () :precondition () :effect (assign (y) (- (* 3 (x)) 1)))
    (:action swap :parameters () :precondition (= (y) 11) :effect (and (assign (x) (y)) (assign (y) (x)) (go))))",
                          "(:init (= (x) 1) (= (y) 0)) (:goal (and (go) (= (x) 11) (= (y) 4)))");
  expect_valid(made, solved(made));
}

// R5, R32: only inside the window; with windows as bounds and as steps.
class TimedLiterals : public ::testing::TestWithParam<WindowExtraction> {
 protected:
  Result plan(const std::string& init, const std::string& goal) {
    made_ = model(R"(
      (:requirements :durative-actions :timed-initial-literals)
      (:predicates (open) (ready) (g) (h) (sun))
      (:durative-action prepare :parameters () :duration (= ?duration 12) :condition () :effect (at end (ready)))
      (:durative-action send :parameters () :duration (= ?duration 5)
        :condition (and (at start (ready)) (over all (open))) :effect (at end (g)))
      (:action flash :parameters () :precondition (open) :effect (h)))",
                  "(:init " + init + ") (:goal " + goal + ")");
    Options options;
    options.windows = GetParam();
    Result result = solved(made_, options);
    if (result.plan) expect_valid(made_, result);
    return result;
  }
  testing::Model made_;
};

TEST_P(TimedLiterals, OneWindow) {
  const Result result = plan("(at 10 (open)) (at 20 (not (open)))", "(g)");
  ASSERT_TRUE(result.plan);
  EXPECT_EQ(result.plan->activities[1].start, std::chrono::microseconds(12001000));
  const NetworkPoint& start = result.plan->network.points[result.plan->activities[1].start_point];
  EXPECT_EQ(start.latest, std::chrono::seconds(15));
  EXPECT_EQ(plan("(at 10 (open)) (at 17 (not (open)))", "(g)").verdict, Verdict::unsolvable);
}

TEST_P(TimedLiterals, TheFirstWindowsAreTooEarlyOrTooShort) {
  const Result result = plan(
      "(open) (at 8 (not (open))) (at 10 (open)) (at 16 (not (open))) (at 20 (open)) (at 24 (not (open)))"
      "(at 30 (open)) (at 35 (not (open))) (at 40 (open))",
      "(g)");
  ASSERT_TRUE(result.plan);
  EXPECT_EQ(result.plan->activities[1].start, std::chrono::seconds(30));
}

TEST_P(TimedLiterals, AConditionAtAPointKeepsItsDistance) {
  const Result result = plan("(at 10 (open))", "(h)");
  ASSERT_TRUE(result.plan);
  EXPECT_EQ(result.plan->activities[0].start, std::chrono::milliseconds(10001));
}

TEST_P(TimedLiterals, GoalsCountWhenThePlanEnds) {
  // the sun sets at 15; whatever must be done has to be done before
  EXPECT_TRUE(plan("(sun) (at 15 (not (sun)))", "(and (ready) (sun))").plan);
  EXPECT_EQ(plan("(sun) (at 11 (not (sun)))", "(and (ready) (sun))").verdict, Verdict::unsolvable);
  EXPECT_TRUE(plan("(sun) (at 3 (not (sun))) (at 5 (sun)) (at 15 (not (sun)))", "(and (ready) (sun))").plan);
}

INSTANTIATE_TEST_SUITE_P(AllModes, TimedLiterals,
                         ::testing::Values(WindowExtraction::none, WindowExtraction::one_off,
                                           WindowExtraction::recurring));

TEST(Planner, TimedValuesChangeNumbers) {
  const auto made =
      model(R"(
    (:requirements :durative-actions :numeric-fluents :timed-initial-literals) (:predicates (g)) (:functions (power))
    (:durative-action work :parameters () :duration (= ?duration 5) :condition (over all (>= (power) 10))
      :effect (at end (g))))",
            "(:init (= (power) 0) (at 10 (= (power) 20)) (at 14 (= (power) 5)) (at 20 (= (power) 12)))"
            "(:goal (g))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_EQ(result.plan->activities[0].start, std::chrono::seconds(20));
}

TEST(Planner, TwoEpsilons) {
  const auto made = model(
      "(:predicates (p) (q)) (:action a :parameters () :precondition () :effect (p))"
      "(:action b :parameters () :precondition (p) :effect (q))",
      "(:init) (:goal (q))");
  for (const int epsilon : {1000, 250000}) {
    Options options;
    options.epsilon = Duration(epsilon);
    const Result result = solved(made, options);
    expect_valid(made, result, options);
    EXPECT_EQ(result.plan->makespan, Duration(epsilon));
  }
}

TEST(Planner, NothingToDo) {
  const auto made = model("(:predicates (p)) (:action a :parameters () :precondition (p) :effect (not (p)))",
                          "(:init (p)) (:goal (p))");
  const Result result = solved(made);
  expect_valid(made, result);
  EXPECT_TRUE(result.plan->activities.empty());
}

TEST(Planner, AnActionWithoutDurationCannotUndoWhatItsStartDoes) {
  const auto made = model(R"((:requirements :durative-actions) (:predicates (at-a) (at-b) (g))
    (:durative-action stay :parameters () :duration (= ?duration 0) :condition (at start (at-a))
      :effect (and (at start (not (at-a))) (at end (at-a)) (at end (g)))))",
                          "(:init (at-a)) (:goal (g))");
  const Result result = solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_GT(result.statistics.temporally_inconsistent, 0u);
}

TEST(Planner, AMissedWindowIsToldWithHowMuchIsMissing) {
  const auto made =
      model(R"((:requirements :durative-actions :timed-initial-literals) (:predicates (open) (p) (g) (h))
    (:durative-action slow :parameters () :duration (= ?duration 9) :condition () :effect (at end (p)))
    (:durative-action a :parameters () :duration (= ?duration 1) :condition (and (at start (p)) (over all (open)))
      :effect (at end (g)))
    (:action b :parameters () :precondition () :effect (h)))",
            "(:init (open) (at 9 (not (open)))) (:goal (and (g) (h)))");
  const Result result = solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_EQ(result.reason,
            "(g) cannot be reached in time: (a) can start no sooner than 9.000 s, but must by 8.000 s: "
            "1.000 s too late");
}

TEST(Planner, AnExhaustedSearchSaysWhatWasNeverReached) {
  const auto made = model(R"((:predicates (p) (q) (g) (h))
    (:action a :parameters () :precondition (p) :effect (and (not (p)) (q)))
    (:action c :parameters () :precondition (and (p) (q)) :effect (g))
    (:action b :parameters () :precondition () :effect (h)))",
                          "(:init (p)) (:goal (and (g) (h)))");
  const Result result = solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("(g)"));
  EXPECT_THAT(result.reason, ::testing::Not(::testing::HasSubstr("(h)")));
}

std::string text_of(const pddl::Condition& condition) { return pddl::print(condition); }

std::string text_of(const pddl::Effect& effect) {
  if (const auto* literal = std::get_if<pddl::Literal>(&effect.node)) return pddl::print(*literal);
  if (const auto* change = std::get_if<pddl::Assignment>(&effect.node)) {
    EXPECT_EQ(change->op, pddl::AssignmentOperator::decrease);
    return "(decrease " + pddl::print(change->fluent) + " " + pddl::print(change->value) + ")";
  }
  const auto& when = std::get<pddl::When>(effect.node);
  return "(when " + pddl::print(when.condition.at_end) + " " + text_of(when.effects.at(0)) + ")";
}

// Conditions and effects leave the engine ground, static facts and folded constants included.
TEST(Planner, ActivitiesCarryTheirConditionsAndEffects) {
  const auto made =
      model(R"(
    (:requirements :adl :durative-actions :numeric-fluents) (:types place)
    (:predicates (at ?p - place) (road ?a ?b - place) (blocked ?p - place))
    (:functions (fuel) (need ?a ?b - place))
    (:durative-action go :parameters (?a ?b - place) :duration (= ?duration 3)
      :condition (and (at start (at ?a)) (over all (road ?a ?b)) (over all (not (blocked ?b)))
                      (at start (>= (fuel) (+ 1 (need ?a ?b)))) (at end (or (at ?a) (not (at ?b)))))
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (decrease (fuel) (need ?a ?b)))
                   (at end (forall (?p - place) (when (blocked ?p) (not (blocked ?p))))))))",
            "(:objects a b - place) (:init (at a) (road a b) (= (fuel) 9) (= (need a b) 2)) (:goal (at b))");
  const Result result = solved(made);
  expect_valid(made, result);
  const Activity& go = result.plan->activities[0];
  const auto texts = [](const auto& list) {
    std::vector<std::string> out;
    for (const auto& item : list) out.push_back(text_of(item));
    return out;
  };
  EXPECT_THAT(texts(go.at_start), ::testing::ElementsAre("(at a)", "(>= (fuel) 3)"));
  EXPECT_THAT(texts(go.over_all), ::testing::ElementsAre("(road a b)", "(not (blocked b))"));
  EXPECT_TRUE(std::holds_alternative<pddl::Not>(go.over_all[1].node));
  EXPECT_THAT(texts(go.at_end), ::testing::ElementsAre("(or (at a) (not (at b)))"));
  EXPECT_TRUE(std::holds_alternative<pddl::Or>(go.at_end[0].node));
  EXPECT_THAT(texts(go.end_effects),
              ::testing::ElementsAre("(at b)", "(decrease (fuel) 2)", "(when (blocked a) (not (blocked a)))",
                                     "(when (blocked b) (not (blocked b)))"));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
