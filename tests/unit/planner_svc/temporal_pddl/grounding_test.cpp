#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "planner_svc/temporal_pddl/grounding/grounder.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options, call::WindowExtraction;
using grounding::Grounding;
using task::Action, task::ActionId, task::FactId, task::NumericCondition, task::SnapId, task::Task,
    task::TimeWindow;
using temporal::Duration, temporal::Verdict, temporal::no_bound;
using testing::action, testing::fact, testing::grounded, testing::model;

std::vector<std::string> actions(const Task& task) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < task.actions.size(); ++i) names.push_back(name(task, ActionId(i)));
  return names;
}

std::vector<std::string> conditions(const Task& task, const std::string& of) {
  std::vector<std::string> names;
  for (const FactId condition : task.conditions[task.actions[action(task, of)].start])
    names.push_back(name(task, condition));
  return names;
}

// 60 objects in five parameters would make 777 million instances; the static chain leaves 56.
TEST(Grounding, JoinsStaticConditionsInsteadOfEnumerating) {
  std::string objects, init = "(on n0)";
  for (int i = 0; i < 60; ++i) objects += " n" + std::to_string(i);
  for (int i = 0; i + 1 < 60; ++i)
    init += " (next n" + std::to_string(i) + " n" + std::to_string(i + 1) + ")";
  const auto made = model(R"(
    (:predicates (on ?x) (next ?x ?y))
    (:action walk :parameters (?a ?b ?c ?d ?e)
      :precondition (and (on ?a) (next ?d ?e) (next ?a ?b) (next ?c ?d) (next ?b ?c))
      :effect (and (not (on ?a)) (on ?e) (on ?b))))",
                          "(:objects" + objects + ") (:init " + init + ") (:goal (on n59))");
  EXPECT_EQ(grounded(made).task.actions.size(), 56u);
}

TEST(Grounding, KeepsOnlyWhatIsReachable) {
  const auto made =
      model(R"(
    (:requirements :typing)
    (:types place) (:predicates (at ?p - place) (road ?a ?b - place) (lit))
    (:action go :parameters (?a ?b - place) :precondition (and (at ?a) (road ?a ?b))
      :effect (and (not (at ?a)) (at ?b)))
    (:action light :parameters () :precondition (at d) :effect (lit)) (:constants d - place))",
            "(:objects a b c - place) (:init (at a) (road a b) (road b c) (road d a)) (:goal (at c))");
  EXPECT_THAT(actions(grounded(made).task), ::testing::UnorderedElementsAre("(go a b)", "(go b c)"));
}

TEST(Grounding, NamesTheGoalThatNothingReaches) {
  const auto made =
      model("(:predicates (p) (q) (r)) (:action a :parameters () :precondition (r) :effect (q))",
            "(:init (p)) (:goal (and (p) (q)))");
  const Result result = testing::solved(made);
  EXPECT_EQ(result.verdict, Verdict::unsolvable);
  EXPECT_THAT(result.reason, ::testing::HasSubstr("(q)"));
  EXPECT_THAT(result.reason, ::testing::Not(::testing::HasSubstr("(p)")));
}

TEST(Grounding, DropsActionsThatCannotEnd) {
  const auto made = model(R"(
    (:requirements :durative-actions) (:predicates (p) (q) (never))
    (:durative-action a :parameters () :duration (= ?duration 1) :condition (at end (never)) :effect (at start (p)))
    (:durative-action b :parameters () :duration (= ?duration 1) :condition (at start (p)) :effect (at end (q))))",
                          "(:init) (:goal (q))");
  EXPECT_EQ(testing::solved(made).verdict, Verdict::unsolvable);
}

TEST(Grounding, AnActionMayBringAboutItsOwnInvariantAndEnd) {
  const auto made = model(R"(
    (:requirements :durative-actions) (:predicates (p ?x) (q ?x) (g ?x))
    (:durative-action a :parameters (?x ?y) :duration (= ?duration 1) :condition (and (over all (p ?y)) (at end (q ?x)))
      :effect (and (at start (p ?x)) (at start (q ?x)) (at end (g ?x)))))",
                          "(:objects o) (:init) (:goal (g o))");
  EXPECT_EQ(testing::solved(made).verdict, Verdict::solved);
}

TEST(Grounding, NegativeConditionsAndEquality) {
  const auto made = model(R"(
    (:requirements :negative-preconditions :equality)
    (:predicates (p ?x) (fixed ?x) (done ?x ?y))
    (:action a :parameters (?x ?y) :precondition (and (not (= ?x ?y)) (not (p ?x)) (not (fixed ?x)))
      :effect (and (done ?x ?y) (p ?y)))
    (:action same :parameters (?x ?y) :precondition (and (= ?x ?y) (p ?x)) :effect (not (p ?x))))",
                          "(:objects a b c) (:init (fixed c)) (:goal (and (done a b) (done b a)))");
  const Task task = grounded(made).task;
  EXPECT_THAT(actions(task), ::testing::UnorderedElementsAre("(a a b)", "(a a c)", "(a b a)", "(a b c)",
                                                             "(same a a)", "(same b b)", "(same c c)"));
  EXPECT_THAT(conditions(task, "(a a b)"), ::testing::ElementsAre("(not (p a))"));
  EXPECT_EQ(testing::solved(made).plan->activities.size(), 3u);
}

TEST(Grounding, QuantifiersAreWrittenOut) {
  const auto made =
      model(R"(
    (:requirements :adl)
    (:predicates (p ?x) (r ?x) (all-done) (some-done) (in ?x))
    (:action do :parameters (?x) :precondition () :effect (p ?x))
    (:action finish :parameters () :precondition (forall (?x) (imply (in ?x) (p ?x))) :effect (all-done))
    (:action pick :parameters () :precondition (exists (?x) (and (p ?x) (r ?x))) :effect (some-done)))",
            "(:objects a b c) (:init (in a) (in b) (r c)) (:goal (and (all-done) (some-done)))");
  const Task task = grounded(made).task;
  EXPECT_THAT(conditions(task, "(finish)"), ::testing::UnorderedElementsAre("(p a)", "(p b)"));
  EXPECT_THAT(conditions(task, "(pick)"), ::testing::ElementsAre("(p c)"));
  EXPECT_EQ(testing::solved(made).plan->activities.size(), 5u);
}

TEST(Grounding, AlternativesBecomeActions) {
  const auto made = model(R"(
    (:requirements :disjunctive-preconditions)
    (:predicates (p) (q) (r) (g))
    (:action make-p :parameters () :precondition () :effect (and (p) (not (q))))
    (:action make-q :parameters () :precondition () :effect (and (q) (not (p))))
    (:action a :parameters () :precondition (or (p) (and (q) (r)) (and (p) (q))) :effect (g)))",
                          "(:init (r)) (:goal (g))");
  EXPECT_THAT(actions(grounded(made).task),
              ::testing::UnorderedElementsAre("(make-p)", "(make-q)", "(a)", "(a)"));
}

TEST(Grounding, ConditionalEffectsHappenOrNot) {
  const auto made = model(R"(
    (:requirements :adl :durative-actions)
    (:predicates (wet) (dry) (g) (h))
    (:action rain :parameters () :precondition () :effect (and (wet) (not (dry))))
    (:durative-action walk :parameters () :duration (= ?duration 2) :condition ()
      :effect (and (at end (when (wet) (g))) (when (at start (dry)) (at end (h))))))",
                          "(:init (dry)) (:goal (and (g) (h)))");
  Options options;
  options.compress_all_actions = false;  // else it walks twice
  const Result result = testing::solved(made, options);
  ASSERT_TRUE(result.plan);
  // walk starts dry, rain falls meanwhile, walk ends wet
  EXPECT_EQ(result.plan->activities.size(), 2u);
  EXPECT_EQ(result.plan->activities[0].name, "walk");
}

TEST(Grounding, AForAllEffectThatOnlyClearsIsOneAction) {
  std::string objects;
  for (int i = 0; i < 20; ++i) objects += " o" + std::to_string(i);
  const auto made = model(R"(
    (:requirements :adl) (:predicates (p ?x) (g))
    (:action set :parameters (?x) :precondition () :effect (p ?x))
    (:action clear :parameters () :precondition () :effect (and (g) (forall (?x) (when (p ?x) (not (p ?x))))))
    (:action use :parameters (?x) :precondition (not (p ?x)) :effect (p ?x)))",
                          "(:objects" + objects + ") (:init) (:goal (and (g) (p o3)))");
  EXPECT_EQ(grounded(made).task.actions.size(), 41u);
}

TEST(Grounding, ConstantsAreFoldedAndUndefinedOnesForbidTheInstance) {
  const auto made = model(R"(
    (:requirements :typing :durative-actions :numeric-fluents)
    (:types place) (:predicates (at ?p - place))
    (:functions (dist ?a ?b - place) (speed) (fuel))
    (:durative-action go :parameters (?a ?b - place) :duration (= ?duration (/ (dist ?a ?b) (speed)))
      :condition (and (at start (at ?a)) (at start (>= (fuel) (* 2 (dist ?a ?b)))))
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (decrease (fuel) (* 2 (dist ?a ?b)))))))",
                          R"((:objects a b c - place)
    (:init (at a) (= (dist a b) 10) (= (dist b c) 5) (= (speed) 2) (= (fuel) 30)) (:goal (at c)))");
  const Task task = grounded(made).task;
  EXPECT_THAT(actions(task), ::testing::UnorderedElementsAre("(go a b)", "(go b c)"));
  const Action& first = task.actions[action(task, "(go a b)")];
  EXPECT_EQ(first.min_duration, std::chrono::seconds(5));
  EXPECT_EQ(first.max_duration, std::chrono::seconds(5));
  const NumericCondition needs = task.comparisons[first.start][0];
  EXPECT_EQ(task.expressions[needs.expression].constant, -20);
}

TEST(Grounding, NumbersThatNothingReadsAreDroppedUnlessTheMetricDoes) {
  for (const bool measured : {false, true}) {
    const auto made =
        model(R"((:requirements :numeric-fluents) (:predicates (g)) (:functions (total-cost) (x))
    (:action a :parameters () :precondition (>= (x) 1) :effect (and (g) (increase (total-cost) 5)))
    (:action b :parameters () :precondition () :effect (increase (x) 1)))",
              std::string("(:init (= (total-cost) 0) (= (x) 0)) (:goal (g))") +
                  (measured ? "(:metric minimize (total-cost))" : ""));
    const Task task = grounded(made).task;
    const SnapId a = task.actions[action(task, "(a)")].start;
    EXPECT_EQ(task.numeric_effects[a].size(), measured ? 1u : 0u);
    EXPECT_EQ(task.numeric_effects[task.actions[action(task, "(b)")].start].size(), 1u);
    EXPECT_TRUE(task.writes[a].empty());  // what only goals or the metric ask for keeps no actions apart
  }
}

class Windows : public ::testing::Test {
 protected:
  Task task(const char* init, WindowExtraction mode) {
    Options options;
    options.windows = mode;
    const auto made = model(R"(
      (:requirements :durative-actions :timed-initial-literals) (:predicates (open) (g))
      (:durative-action a :parameters () :duration (= ?duration 2)
        :condition (and (at start (open)) (over all (open))) :effect (at end (g))))",
                            std::string("(:init ") + init + ") (:goal (g))");
    return grounded(made, options).task;
  }
  static std::vector<TimeWindow> starts(const Task& task) {
    const auto windows = task.windows[task.actions[ActionId(0)].start];
    return {windows.begin(), windows.end()};
  }
};

constexpr Duration kMs{1000};

TEST_F(Windows, AFactThatIsTrueOnceBoundsTheSteps) {
  const char* init = "(at 10 (open)) (at 20 (not (open)))";
  for (const auto mode : {WindowExtraction::one_off, WindowExtraction::recurring}) {
    const Task made = task(init, mode);
    EXPECT_TRUE(made.timed_steps.empty());
    EXPECT_TRUE(fact(made, "(open)").is_none());
    EXPECT_EQ(starts(made), (std::vector<TimeWindow>{{10001 * kMs, 18000 * kMs}}));
  }
  EXPECT_EQ(task(init, WindowExtraction::none).timed_steps.size(), 2u);
}

// R34: what a state takes does not depend on how many timed literals bound its steps.
TEST(TimedLiteralBounds, BytesPerStateAreTheSameForAnyNumberOfTimedLiterals) {
  const auto bytes = [](int windows) {
    std::string init = "(at p0)", goal;
    for (int i = 0; i < 6; ++i) {
      init += "(road p" + std::to_string(i) + " p" + std::to_string(i + 1) + ")";
      for (int w = 0; w < windows; ++w) {
        const std::string lit = "(lit p" + std::to_string(i) + ")";
        init += "(at " + std::to_string(1000 * w + 10) + " " + lit + ") (at " +
                std::to_string(1000 * w + 900) + " (not " + lit + "))";
      }
      goal += "(seen p" + std::to_string(i) + ")";
    }
    const Result result = testing::solved(model(
        R"((:requirements :typing :durative-actions :timed-initial-literals) (:types place)
      (:predicates (at ?p - place) (road ?a ?b - place) (lit ?p - place) (seen ?p - place))
      (:durative-action go :parameters (?a ?b - place) :duration (= ?duration 20)
        :condition (and (at start (at ?a)) (at start (road ?a ?b)))
        :effect (and (at start (not (at ?a))) (at end (at ?b))))
      (:durative-action see :parameters (?p - place) :duration (= ?duration 5)
        :condition (and (over all (at ?p)) (over all (lit ?p))) :effect (at end (seen ?p))))",
        "(:objects p0 p1 p2 p3 p4 p5 p6 - place) (:init " + init + ") (:goal (and " + goal + "))"));
    EXPECT_EQ(result.verdict, Verdict::solved) << result.reason;
    return result.statistics.bytes_per_state;
  };
  const double one = bytes(1);
  EXPECT_GT(one, 0);
  EXPECT_EQ(bytes(4), one);
  EXPECT_EQ(bytes(64), one);
}

TEST_F(Windows, ADeadlineIsAWindowFromTheBeginning) {
  EXPECT_EQ(starts(task("(open) (at 20 (not (open)))", WindowExtraction::one_off)),
            (std::vector<TimeWindow>{{Duration{0}, 18000 * kMs}}));
}

TEST_F(Windows, RecurringOnesAreNotOneOff) {
  const char* init = "(at 10 (open)) (at 20 (not (open))) (at 30 (open)) (at 31 (not (open))) (at 40 (open))";
  EXPECT_EQ(task(init, WindowExtraction::one_off).timed_steps.size(), 5u);
  // the second one is too short for the action
  EXPECT_EQ(starts(task(init, WindowExtraction::recurring)),
            (std::vector<TimeWindow>{{10001 * kMs, 18000 * kMs}, {40001 * kMs, no_bound}}));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
