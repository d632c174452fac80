// A goal with alternatives: one of them at a time is searched for.
#include "planner_svc/temporal_pddl/search/goal_alternatives.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "core/pddl/check.hpp"
#include "planner_svc/temporal_pddl/heuristics/ff.hpp"
#include "tests/unit/planner_svc/temporal_pddl/validated.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Budget, call::Monitor, call::Options, call::SearchLimits, call::Statistics;
using dead_ends::DeadEndDetectors;
using heuristics::FfHeuristic;
using search::GoalAlternatives, search::SearchOutcome;
using task::ActionCompression, task::Task;
using temporal::Verdict;

// A walk over places of which some cannot be left for others; `goal` names alternatives.
testing::Model walk(const std::string& goal) {
  return testing::model(
      R"((:requirements :durative-actions)
    (:predicates (at ?p) (way ?a ?b) (seen ?p))
    (:durative-action go :parameters (?a ?b) :duration (= ?duration 3)
      :condition (and (at start (at ?a)) (over all (way ?a ?b)))
      :effect (and (at start (not (at ?a))) (at end (at ?b)) (at end (seen ?b)))))",
      "(:objects a b c d e) (:init (at a) (way a b) (way a c) (way c d) (way d a) (way a e) (way e a)) "
      "(:goal " +
          goal + ")");
}

class GoalAlternativesTest : public ::testing::Test {
 protected:
  std::optional<SearchOutcome> run(const testing::Model& model, std::size_t evaluations) {
    task_ = testing::grounded(model).task;
    FfHeuristic ff(task_);
    SearchLimits limits(budget_, monitor_);
    GoalAlternatives search({task_, options_, limits, statistics_}, {ff, detectors_},
                            ActionCompression::always);
    EXPECT_FALSE(search.complete());
    return search.run(evaluations, 0);
  }

  Budget budget_;
  Monitor monitor_;
  Options options_;
  Statistics statistics_;
  DeadEndDetectors detectors_;
  Task task_;
};

// No way leads on from b.
TEST_F(GoalAlternativesTest, AnAlternativeThatCannotBeIsFollowedByTheNext) {
  const auto outcome = run(walk("(or (and (seen b) (at c)) (and (seen b) (at d)) (at d))"), 1000);
  ASSERT_TRUE(outcome && outcome->plan);
  EXPECT_TRUE(task_.layout.holds(outcome->final_state, testing::fact(task_, "(at d)")));
}

TEST_F(GoalAlternativesTest, WhereNoneCanBeItEndsWithoutAPlan) {
  const auto outcome = run(walk("(or (and (seen b) (at d)) (and (seen b) (at c)))"), 1000);
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->plan);
}

TEST_F(GoalAlternativesTest, OneAloneAndMoreThanCanBeTriedAreLeftToTheOthers) {
  EXPECT_FALSE(GoalAlternatives::has_some(testing::grounded(walk("(at d)")).task));
  EXPECT_TRUE(GoalAlternatives::has_some(testing::grounded(walk("(or (at d) (at b))")).task));
  EXPECT_FALSE(
      GoalAlternatives::has_some(testing::grounded(walk("(exists (?p ?q) (and (seen ?p) (at ?q)))")).task));
}

// Answers every drive alike.
class OneForAll final : public engine::FunctionSource {
 public:
  std::vector<engine::FunctionValue> evaluate(std::span<const engine::FunctionCall> asked,
                                              const std::function<bool()>&) override {
    engine::FunctionValue value;
    value.outcome = engine::FunctionOutcome::value;
    value.value = 25;
    return std::vector(asked.size(), value);
  }
};

// The orbital mission's domain, with the arm at rest in light and this besides.
testing::Model orbiter(const std::string& init, const std::string& goal) {
  std::ostringstream domain;
  domain << std::ifstream(ROCI_SOURCE_DIR "/missions/orbital/domain.pddl").rdbuf();
  testing::Model model;
  model.domain = pddl::load_domain(domain.str(), "domain.pddl");
  model.problem = pddl::load_problem(
      "(define (problem p) (:domain orbital) (:objects home - slot  power imaging - role  survey - mode"
      "  camera-1 camera-2 power-1 - module  s0 s1 s2 s3 - socket)\n(:init (arm-at home) (arm-first home)"
      " (tool-ready) (array-ready) (sunlit) (= (battery) 800000) (= (reserve) 150000) (= (capacity) 800000)"
      " (at-slot camera-1 s0) (lay-first camera-1 s0) (installed camera-1 s0)"
      " (at-slot camera-2 s1) (lay-first camera-2 s1) (installed camera-2 s1) (works camera-2)"
      " (at-slot power-1 s2) (lay-first power-1 s2) (installed power-1 s2) (works power-1)"
      " (free s3) (free-first s3) (seat camera-1 s0) (serves camera-1 imaging) (serves camera-2 imaging)"
      " (serves power-1 power) " +
          init + ") (:goal " + goal + ") (:metric minimize (total-time)))",
      "problem.pddl", model.domain);
  return model;
}

constexpr char kReplaced[] =
    "(exists (?b - module ?s - socket ?r - role) (and (seat camera-1 ?s) (serves camera-1 ?r) (serves ?b ?r) "
    "(works ?b) (not (= ?b camera-1)) (installed ?b ?s)))";
constexpr char kConfigured[] =
    "(forall (?r - role ?s - socket) (imply (needs survey ?r ?s) (exists (?m - module) (and (serves ?m ?r) "
    "(works ?m) (installed ?m ?s)))))";

// When the plan places camera-2 in s0; nothing: it does not.
std::optional<double> placed_at(const Result& result) {
  if (!result.plan) return std::nullopt;
  for (const auto& activity : result.plan->activities)
    if (activity.name == "place" && activity.arguments == std::vector<std::string>{"camera-2", "s0"})
      return temporal::to_seconds(activity.start);
  return std::nullopt;
}

// R55: a configuration by a time. What is placed for the goal is placed in its window; what is parked is not bound by it.
TEST(WindowsOfTheOrbiter, HoldForReplaceAndConfigure) {
  OneForAll values;
  for (const auto& [wish, window, goal] :
       {std::tuple{"(to-replace camera-1)", "(replacing camera-1)", kReplaced},
        std::tuple{"(to-configure survey) (needs survey imaging s0)", "(configuring survey)", kConfigured}}) {
    const auto with = [&, wish = std::string(wish), window = std::string(window)](const std::string& when) {
      std::string init = wish;
      for (const char c : when) init += c == '*' ? window : std::string(1, c);
      return testing::solved(orbiter(init, goal), values, {});
    };
    const auto soon = placed_at(with(" *"));
    ASSERT_TRUE(soon) << goal;
    const auto late = placed_at(with(" (at 1000 *) (at 1500 (not *))"));
    ASSERT_TRUE(late) << goal;
    EXPECT_GT(*soon, 100);
    EXPECT_LT(*soon, 1000);
    EXPECT_GE(*late, 1000);
    EXPECT_LE(*late, 1500 - 60);
    const Result closed = with(" * (at 100 (not *))");
    EXPECT_EQ(closed.verdict, Verdict::unsolvable) << goal;
  }
}

// R55: "works in slot s": a damaged module does not, wherever it is latched.
TEST(WindowsOfTheOrbiter, ADamagedModuleIsInstalledNowhere) {
  OneForAll values;
  const std::string wanted = "(wanted camera-1 s3) (allowed camera-1 s3)";
  const Result damaged =
      testing::solved(orbiter(wanted, "(and (installed camera-1 s3) (works camera-1))"), values, {});
  EXPECT_EQ(damaged.verdict, Verdict::unsolvable);
  const Result mended = testing::solved(
      orbiter(wanted + " (works camera-1)", "(and (installed camera-1 s3) (works camera-1))"), values, {});
  EXPECT_EQ(mended.verdict, Verdict::solved);
}

// The arm holds one spare, and the slot for which it was meant is blocked; another module would do as well. Estimates
// for either led to and fro between the two: 22,000 evaluations, and in a flight, seed 9138, more than the budget.
TEST(GoalAlternativesOfTheOrbiter, AModuleIsReplacedWhicheverOfTwoDoesIt) {
  std::ostringstream domain;
  domain << std::ifstream(ROCI_SOURCE_DIR "/missions/orbital/domain.pddl").rdbuf();
  testing::Model model;
  model.domain = pddl::load_domain(domain.str(), "domain.pddl");
  model.problem = pddl::load_problem(R"((define (problem replace) (:domain orbital)
    (:objects home - slot  power - role  power-1 power-2 power-3 - module  s0 s1 s3 s6 s8 s11 - socket)
    (:init
      (arm-at s3) (arm-first s3) (holding power-3) (held-first power-3) (loaded) (tool-ready) (array-ready) (sunlit)
      (at-slot power-1 s0) (lay-first power-1 s0) (installed power-1 s0) (works power-1)
      (at-slot power-2 s1) (lay-first power-2 s1) (installed power-2 s1) (damaged power-2) (to-replace power-2) (replacing power-2)
      (works power-3) (free s6) (free-first s6) (free s8) (free-first s8) (free s11) (free-first s11)
      (seat power-1 s0) (seat power-2 s1)
      (serves power-1 power) (serves power-2 power) (serves power-3 power)
      (= (battery) 800000) (= (reserve) 150000) (= (capacity) 800000))
    (:goal (exists (?b - module ?s - socket ?r - role)
      (and (seat power-2 ?s) (serves power-2 ?r) (serves ?b ?r) (works ?b) (not (= ?b power-2)) (installed ?b ?s))))
    (:metric minimize (total-time))))",
                                     "problem.pddl", model.domain);
  OneForAll values;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    Options options;
    options.seed = seed;
    const Result result = testing::solved(model, values, options);
    EXPECT_EQ(result.verdict, Verdict::solved);
    EXPECT_LE(result.statistics.evaluated, 5000u) << "seed " << seed;
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
