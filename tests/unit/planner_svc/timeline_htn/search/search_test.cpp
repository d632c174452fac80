// How plans come about: forward in time, with the hierarchy built above the timelines (R130, R133, R134, R137).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/temporal/network_distances.hpp"
#include "core/temporal/schedule.hpp"
#include "planner_svc/timeline_htn/checking/check.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn {
namespace {

using search::Heuristic, search::Order, search::Outcome;
using temporal::Duration, temporal::FlexiblePlan, temporal::PlanActivity, temporal::seconds;
using testing::Contains, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty, testing::IsSupersetOf,
    testing::Not;

const std::string kRovers = R"yaml(domain: rovers
types: [place]
objects: {place: [a, b, c, d]}
relations:
  edge: {arguments: [place, place], rows: [[a, b], [a, c], [c, d], [b, a]]}
components:
  mission:
    layer: abstract
    states:
      idle: {kind: default}
      visit: {kind: complex, parameters: {from: place, to: place}}
    transitions: ["idle <-> visit(x, y)"]
  wheels:
    layer: primitive
    robot: rover
    states:
      at: {kind: default, parameters: {place: place}}
      drive:
        kind: simple
        parameters: {from: place, to: place}
        where: ["edge(from, to)"]
        duration_s: [10, 20]
        command: {owner: sim, component: wheels, command: drive, arguments: {to: to, mode: slow}}
        needs: [during arm.folded]
        contingency: halt
      stuck: {kind: error, parameters: {place: place}}
      rock: {kind: simple, parameters: {place: place}, duration_s: [3, 5], command: {owner: sim, command: rock}}
    transitions: ["at(x) -> drive(x, y)", "drive(x, y) -> at(y)", "stuck(x) -> rock(x)", "rock(x) -> at(x)"]
  arm:
    layer: primitive
    states:
      folded: {kind: default}
      unfolding: {kind: simple, duration_s: 4, command: {owner: sim, command: unfold}}
      out: {kind: default}
      sampling: {kind: simple, duration_s: [5, 9], command: {owner: sim, command: sample}}
      folding: {kind: simple, duration_s: 4, command: {owner: sim, command: fold}}
    transitions: [folded -> unfolding, unfolding -> out, out <-> sampling, out -> folding, folding -> folded]
)yaml";
const std::string kBehaviours = R"yaml(behaviours:
  last:
    achieves: mission.visit(from, to)
    where: ["edge(from, to)"]
    conditions: [wheels.at(from)]
    subgoals: {drive: "wheels.drive(from, to)", sample: arm.sampling}
    constraints: [drive before sample]
  on:
    achieves: mission.visit(from, to)
    variables: {next: place}
    where: ["edge(from, next)", "next != to"]
    conditions: [wheels.at(from)]
    subgoals: {drive: "wheels.drive(from, next)", rest: "mission.visit(next, to)"}
    constraints: [drive before rest]
)yaml";
const std::string kProblem = R"yaml(problem:
  horizon_s: 500
  initial: {mission: idle, wheels: at(a), arm: out}
  goals: {there: "mission.visit(a, d)"}
)yaml";

const std::string& name_of(const FlexiblePlan& plan, const std::string& id) {
  return std::ranges::find(plan.activities, id, &PlanActivity::id)->name;
}

// The hierarchy is built, not replaced: every level stands in the plan, each part under what it is a part of.
TEST(TimelineSearch, EveryLevelStaysInThePlan) {
  const auto result = planned(model_of({kRovers, kBehaviours, kProblem}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  const auto* top = result.find("mission.visit(a, d)");
  const auto* within = result.find("mission.visit(c, d)");
  const auto* drive = result.find("wheels.drive(c, d)");
  ASSERT_TRUE(top && within && drive);
  EXPECT_EQ(top->parent, "");
  EXPECT_EQ(top->level, "abstract");
  EXPECT_EQ(within->parent, top->id);
  EXPECT_EQ(name_of(*result.plan, drive->parent), "mission.visit(c, d)");
  EXPECT_EQ(drive->level, "primitive");
  EXPECT_EQ(drive->owner, "sim");
  EXPECT_EQ(drive->robot, "rover");
  EXPECT_THAT(drive->arguments,
              ElementsAre(temporal::Property{"to", "d"}, temporal::Property{"mode", "slow"}));
  EXPECT_EQ(drive->lateness, temporal::LatenessPolicy::deadline);
  EXPECT_EQ(drive->contingency, "halt");
  EXPECT_EQ(drive->duration_lower, seconds(10));
  EXPECT_THAT(drive->goals_served, ElementsAre("there"));
  EXPECT_TRUE(top->owner.empty());
}

// The arm must be folded while the rover drives, so it cannot sample at the very end of a drive: the search finds that
// and takes the other behaviour.
TEST(TimelineSearch, WhereTheFirstDecompositionFailsAnotherIsFound) {
  const std::string hasty =
      kBehaviours +
      "  hasty: {achieves: \"mission.visit(from, to)\", priority: 5, where: [\"edge(from, to)\"], "
      "subgoals: {drive: \"wheels.drive(from, to)\", sample: arm.sampling}, constraints: [drive "
      "meets sample]}\n";
  const auto result =
      planned(model_of({kRovers, hasty, with(kProblem, "mission.visit(a, d)", "mission.visit(a, c)")}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_THAT(result.names(), Contains("arm.sampling"));
  EXPECT_GT(result.count.refused, 0U);
}

// The way to b leads nowhere but back: it is not begun.
TEST(TimelineSearch, ARecursionThatCannotEndIsNotBegun) {
  const auto result = planned(model_of({kRovers, kBehaviours, kProblem}));
  ASSERT_EQ(result.outcome, Outcome::solved);
  EXPECT_THAT(result.names(), Contains("wheels.drive(a, c)"));
  EXPECT_THAT(result.names(), Not(Contains("wheels.drive(a, b)")));
  EXPECT_EQ(result.count.refused + result.count.repeated, 0U);
}

TEST(TimelineSearch, WhatAValueNeedsOfOthersIsBroughtAbout) {
  const auto result = planned(model_of({kRovers, kBehaviours, kProblem}));
  ASSERT_EQ(result.outcome, Outcome::solved);
  EXPECT_THAT(result.names(), IsSupersetOf({"arm.folding", "arm.unfolding", "arm.sampling"}));
}

TEST(TimelineSearch, OtherBehavioursMakeAnotherPlan) {
  const std::string with_look = with(kBehaviours, "subgoals: {drive: \"wheels.drive(from, next)\"",
                                     "subgoals: {look: arm.sampling, drive: \"wheels.drive(from, next)\"");
  const auto one = planned(model_of({kRovers, kBehaviours, kProblem}));
  const auto other = planned(model_of({kRovers, with_look, kProblem}));
  ASSERT_TRUE(one.plan && other.plan);
  EXPECT_EQ(std::ranges::count(one.names(), "arm.sampling"), 1);
  EXPECT_EQ(std::ranges::count(other.names(), "arm.sampling"), 2);
}

TEST(TimelineSearch, OfTwoBehavioursTheOneOfHigherPriorityComesFirst) {
  const std::string two =
      kBehaviours +
      "  fast: {achieves: \"mission.visit(from, to)\", priority: 5, where: [\"edge(from, to)\"], "
      "subgoals: {drive: \"wheels.drive(from, to)\"}}\n";
  const std::string near = with(kProblem, "mission.visit(a, d)", "mission.visit(a, c)");
  EXPECT_THAT(planned(model_of({kRovers, two, near})).names(), Not(Contains("arm.sampling")));
  EXPECT_THAT(planned(model_of({kRovers, with(two, "priority: 5", "priority: -5"), near})).names(),
              Contains("arm.sampling"));
}

TEST(TimelineSearch, AGoalOfEitherLayerIsReached) {
  const auto result =
      planned(model_of({kRovers, kBehaviours, with(kProblem, "mission.visit(a, d)", "wheels.at(c)")}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_THAT(result.names(), ElementsAre("wheels.drive(a, c)", "arm.folding"));
}

TEST(TimelineSearch, GoalsComeInTheirOrder) {
  const std::string two =
      with(kProblem, "goals: {there: \"mission.visit(a, d)\"}",
           "goals: {late: {state: wheels.at(d), after: [there]}, there: \"wheels.at(b)\"}");
  const auto result = planned(model_of({kRovers, kBehaviours, two}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_THAT(result.names(), IsSupersetOf({"wheels.drive(a, b)", "wheels.drive(b, a)", "wheels.drive(a, c)",
                                            "wheels.drive(c, d)"}));
}

// The tending of the mint is a complex state, `out` asks for one to rest in: the steps on the way to either, what those
// need and all their parts wait for the release. A window alone lets the way begin sooner.
TEST(TimelineSearch, NothingThatServesAGoalStartsBeforeItsRelease) {
  const std::string problem = text_of_file("tests/missions/greenhouse/problem.yaml");
  const auto starts_of = [&](const std::string& goals, const std::string& goal) {
    const std::size_t at = problem.find("  goals:");
    const model::Model model =
        model_of({text_of_file("tests/missions/greenhouse/domain.yaml"),
                  text_of_file("tests/missions/greenhouse/behaviours.yaml"),
                  problem.substr(problem.find("objects:"), at - problem.find("objects:")) + "  goals: {" +
                      goals + "}\n"});
    const Planned result = planned(model);
    EXPECT_EQ(result.outcome, Outcome::solved) << result.reason;
    if (!result.plan) return std::pair(Duration{0}, std::size_t{0});
    EXPECT_THAT(checking::faults(model, *result.plan), IsEmpty());
    const temporal::NetworkDistances network(result.plan->point_count,
                                             temporal::all_constraints(*result.plan));
    Duration first = temporal::no_bound;
    std::size_t count = 0;
    for (const auto& activity : result.plan->activities) {
      if (activity.goals_served != std::vector<std::string>{goal}) continue;
      first = std::min(first, network.between(0, activity.start_point).lower);
      ++count;
    }
    return std::pair(first, count);
  };
  EXPECT_EQ(starts_of("mint: {state: care.tending(mint), release_s: 300}", "mint"),
            std::pair(temporal::seconds(300), std::size_t{7}));
  EXPECT_EQ(starts_of("out: {state: base.at(row_a), release_s: 300}", "out"),
            std::pair(temporal::seconds(300), std::size_t{2}));
  EXPECT_EQ(starts_of("out: {state: base.at(row_a), window_s: [300, none]}", "out"),
            std::pair(temporal::seconds(0), std::size_t{2}));
}

// Of components that have nothing else to do with each other, too.
TEST(TimelineSearch, AGoalBeginsWhenTheOneBeforeItHasEnded) {
  const auto start_of_second = [](const std::string& after) {
    const auto result = planned(model_of({R"yaml(domain: pair
components:
  left:
    layer: primitive
    states: {idle: {kind: default}, work: {kind: simple, duration_s: 10, command: {owner: sim, command: work}}}
    transitions: [idle <-> work]
  right:
    layer: primitive
    states: {idle: {kind: default}, work: {kind: simple, duration_s: 10, command: {owner: sim, command: work}}}
    transitions: [idle <-> work]
problem:
  horizon_s: 500
  initial: {left: idle, right: idle}
  goals: {first: left.work, second: {state: right.work, after: [)yaml" +
                                          after + "]}}\n"}));
    EXPECT_EQ(result.outcome, Outcome::solved) << result.reason;
    const auto times =
        temporal::earliest_schedule(result.plan->point_count, temporal::all_constraints(*result.plan));
    return times->at(result.find("right.work")->start_point);
  };
  EXPECT_GE(start_of_second("first"), seconds(10));
  EXPECT_LT(start_of_second(""), seconds(10));
}

// The behaviour that an error triggers comes first, and the goals after it.
TEST(TimelineSearch, AnErrorLeadsToTheBehaviourThatMendsIt) {
  const std::string mend =
      kBehaviours +
      "  free: {triggers: [wheels.stuck(place)], subgoals: {rock: wheels.rock(place), stand: "
      "wheels.at(place)}, constraints: [rock meets stand]}\n";
  const std::string stuck = with(kProblem, "wheels: at(a)", "wheels: stuck(a)");
  const auto result = planned(model_of({kRovers, mend, stuck}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  const auto* rock = result.find("wheels.rock(a)");
  ASSERT_TRUE(rock && result.find("free"));
  EXPECT_EQ(rock->parent, result.find("free")->id);
  const auto times =
      temporal::earliest_schedule(result.plan->point_count, temporal::all_constraints(*result.plan));
  EXPECT_GE((*times)[result.find("mission.visit(a, d)")->start_point],
            (*times)[result.find("free")->end_point]);
}

// A step on the way to the goal is not the goal, and waits like it. What the timeline goes on with at once does not.
TEST(TimelineSearch, StepsTowardsAGoalWaitForWhatMends) {
  const std::string domain =
      "domain: d\ncomponents:\n"
      "  radio:\n    layer: primitive\n    states: {fine: {kind: default}, broken: {kind: error}, reset: "
      "{kind: "
      "simple, duration_s: 60}}\n"
      "    transitions: [broken -> reset, reset -> fine]\n"
      "  arm:\n    layer: primitive\n    states: {folded: {kind: default}, lift: {kind: simple, duration_s: "
      "5}, wave: "
      "{kind: simple, duration_s: 5}, up: {kind: default}, dig: {kind: simple, duration_s: 5}}\n"
      "    transitions: [folded -> lift, lift -> up, up -> dig, dig -> folded, lift -> wave, wave -> "
      "folded]\n";
  const auto schedule = [&](const std::string& behaviour, const std::string& goal) {
    const auto result = planned(model_of(
        {domain + "behaviours:\n  mend: {triggers: [radio.broken], " + behaviour +
         "}\nproblem:\n  horizon_s: 500\n  initial: {radio: broken, arm: folded}\n  goals: {g: " + goal +
         "}\n"}));
    EXPECT_EQ(result.outcome, Outcome::solved) << result.reason;
    std::map<std::string, double> out;
    if (!result.plan) return out;
    const auto times =
        temporal::earliest_schedule(result.plan->point_count, temporal::all_constraints(*result.plan));
    for (const auto& activity : result.plan->activities)
      out.emplace(activity.name, temporal::to_seconds((*times)[activity.start_point]));
    return out;
  };
  const auto apart = schedule("subgoals: {reset: radio.reset}", "arm.dig");
  EXPECT_EQ(apart.at("mend"), 0);
  EXPECT_GE(apart.at("arm.lift"), 60);
  EXPECT_EQ(apart.at("arm.dig"), apart.at("arm.lift") + 5);
  const auto within = schedule("subgoals: {lift: arm.lift, reset: radio.reset}", "arm.dig");
  EXPECT_EQ(within.at("arm.lift"), 0) << "of the mending, so the arm is lifted at once";
  EXPECT_GE(within.at("arm.dig"), 60) << "a goal";
  const auto on = schedule("subgoals: {lift: arm.lift, reset: radio.reset}", "arm.folded");
  EXPECT_EQ(on.at("arm.wave"), 5) << "nothing else can follow";
}

// A state to rest in that is to end where another begins is left for it.
TEST(TimelineSearch, ADefaultStateIsLeftForWhatItIsToEndFor) {
  const auto result = planned(model_of(
      {"domain: d\ncomponents:\n"
       "  gate:\n    layer: primitive\n    states: {closed: {kind: default}, opening: {kind: simple, "
       "duration_s: 5}, "
       "open: {kind: default}}\n    transitions: [closed -> opening, opening -> open, open -> closed]\n"
       "  car:\n    layer: primitive\n    states: {out: {kind: default}, enter: {kind: simple, duration_s: "
       "3, needs: "
       "[met_by gate.closed]}}\n    transitions: [out <-> enter]\n"
       "problem:\n  horizon_s: 100\n  initial: {gate: closed, car: out}\n  goals: {a: car.enter, b: {state: "
       "car.enter, after: [a]}}\n"}));
  ASSERT_EQ(result.outcome, Outcome::solved) << result.reason;
  EXPECT_THAT(result.names(), IsSupersetOf({"car.enter", "gate.opening"}));
  EXPECT_EQ(std::ranges::count(result.names(), "gate.opening"), 2) << "once for each";
}

TEST(TimelineSearch, WhatCannotBeIsProvedWithItsReason) {
  const auto reason = [](const std::string& behaviours, const std::string& problem) {
    const auto result = planned(model_of({kRovers, behaviours, problem}));
    EXPECT_EQ(result.outcome, Outcome::exhausted);
    return result.reason;
  };
  EXPECT_THAT(reason(kBehaviours,
                     with(kProblem, "mission.visit(a, d)", "wheels.at(a)\", \"x\": \"mission.visit(d, a)")),
              HasSubstr("no behaviour achieves mission.visit(d, a) with these objects"));
  EXPECT_THAT(reason(kBehaviours, with(kProblem, "horizon_s: 500", "horizon_s: 20")),
              HasSubstr("time does not permit"));
  EXPECT_THAT(
      reason(
          with(kBehaviours, "conditions: [wheels.at(from)]\n    subgoals: {drive: \"wheels.drive(from, to)",
               "conditions: [not wheels.at(from)]\n    subgoals: {drive: \"wheels.drive(from, to)"),
          with(with(kProblem, "mission.visit(a, d)", "mission.visit(c, d)"), "at(a)", "at(c)")),
      HasSubstr("behaviour 'last' for mission.visit(c, d) asks for not wheels.at(c), and that timeline comes "
                "to wheels.at(c) "
                "alone"));
  EXPECT_THAT(reason(kBehaviours, with(kProblem, "wheels: at(a)", "wheels: at(d)")),
              HasSubstr("asks for wheels.at(a), and that timeline comes to wheels.at(d) alone"));
}

// A node's next value is the one that may start the earliest, and each timeline grows at its end.
TEST(TimelineSearch, GoesForwardInTime) {
  const model::Model model = model_of({text_of_file("tests/missions/greenhouse/domain.yaml"),
                                       text_of_file("tests/missions/greenhouse/behaviours.yaml"),
                                       with(text_of_file("tests/missions/greenhouse/problem.yaml"),
                                            "include: [domain.yaml, behaviours.yaml]", "")});
  search::Search search(model, {});
  ASSERT_EQ(search.run(100'000, 0, [] { return false; }), Outcome::solved);
  const auto& plan = search.plan();
  for (const auto& token : plan.tokens()) {
    if (token.before == search::kNone) continue;
    const auto& before = plan.tokens()[token.before];
    EXPECT_EQ(before.end, token.start);
    EXPECT_GE(plan.network().earliest(token.start), plan.network().earliest(before.start));
  }
}

TEST(TimelineSearch, EachHeuristicAndOrderFindsAPlan) {
  const model::Model model = model_of({kRovers, kBehaviours, kProblem});
  for (const Heuristic heuristic : {Heuristic::blind, Heuristic::relaxed_plan, Heuristic::landmarks})
    for (const Order order : {Order::first_declared, Order::last_declared})
      EXPECT_EQ(planned(model, {heuristic, order}).outcome, Outcome::solved);
}

TEST(TimelineSearch, BudgetsEndIt) {
  const model::Model model = model_of({kRovers, kBehaviours, kProblem});
  search::Search search(model, {});
  EXPECT_EQ(search.run(3, 0, [] { return false; }), Outcome::searching);
  EXPECT_EQ(search.count().evaluated, 3U);
  EXPECT_EQ(search.run(100'000, 0, [] { return false; }), Outcome::solved);
  search::Search small(model, {});
  EXPECT_EQ(small.run(100'000, 10, [] { return false; }), Outcome::out_of_memory);
  search::Search cancelled(model, {});
  EXPECT_EQ(cancelled.run(100'000, 0, [] { return true; }), Outcome::cancelled);
}

// What is taken back leaves nothing behind: going on in slices gives the same plan.
TEST(TimelineSearch, ResumedItFindsTheSamePlan) {
  const model::Model model = model_of({kRovers, kBehaviours, kProblem});
  search::Search slices(model, {});
  for (std::uint64_t work = 1; slices.run(work, 0, [] { return false; }) == Outcome::searching;) ++work;
  EXPECT_EQ(extraction::plan_of(slices, {"plan", "a", temporal::Time{0}}), *planned(model).plan);
}

}  // namespace
}  // namespace roci::planner::timeline_htn
