// Decisions that a plan leaves open (R131).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::extraction {
namespace {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::seconds;
using testing::Contains, testing::ElementsAre, testing::Not, testing::UnorderedElementsAre;

const std::string kTeam = R"yaml(domain: team
types: [route]
objects: {route: [north, middle, south]}
relations:
  open: {arguments: [route], rows: [[north], [south]]}
numbers:
  metres: {arguments: [route], rows: [[north, 10], [middle, 20], [south, 40]]}
components:
  team:
    layer: abstract
    states: {idle: {kind: default}, cycle: {kind: complex}}
    transitions: [idle <-> cycle]
  scout:
    layer: primitive
    states:
      idle: {kind: default}
      explore:
        kind: simple
        parameters: {route: route}
        duration_s: ["metres(route)", "2 * metres(route)"]
        command: {owner: sim, component: scout, command: explore, arguments: {route: route}}
      come_back: {kind: simple, duration_s: [5, 30], command: {owner: sim, component: scout, command: back}}
    transitions: ["idle <-> explore(r)", idle <-> come_back]
  primary:
    layer: primitive
    states:
      idle: {kind: default}
      follow: {kind: simple, duration_s: [20, 60], command: {owner: sim, component: primary, command: follow}}
      report: {kind: simple, duration_s: 5, command: {owner: sim, component: radio, command: report}}
    transitions: [idle <-> follow, idle <-> report]
behaviours:
  cycle:
    achieves: team.cycle
    variables: {route: route}
    where: ["open(route)"]
    subgoals:
      explore: scout.explore(route)
      follow: {state: primary.follow, contingency: stop}
      back: scout.come_back
    constraints: [explore before follow, explore before back]
    decisions:
      which: {resolver: ground, before: explore.start, binds: route}
      go_on:
        resolver: rule
        before: follow.start
        choices: {follow: {subgoals: follow, when: scout.nav = arrived}, bring_back: {subgoals: back}}
problem:
  horizon_s: 600
  initial: {team: idle, scout: idle, primary: idle}
  goals: {cycle: team.cycle, told: {state: primary.report, after: [cycle]}}
)yaml";

TEST(OpenDecisions, AChoiceStandsInThePlanWithAllItsActivities) {
  const auto result = planned(model_of({kTeam}));
  ASSERT_TRUE(result.plan) << result.reason;
  const auto* follow = result.find("primary.follow");
  const auto* back = result.find("scout.come_back");
  const auto* report = result.find("primary.report");
  ASSERT_TRUE(follow && back && report);
  const auto decision =
      std::ranges::find_if(result.plan->decisions, [](const auto& one) { return !one.choices.empty(); });
  ASSERT_NE(decision, result.plan->decisions.end());
  EXPECT_EQ(decision->resolver_kind, temporal::ResolverKind::rule);
  EXPECT_EQ(decision->decide_before, follow->start_point);
  ASSERT_EQ(decision->choices.size(), 2U);
  EXPECT_EQ(decision->choices[0].name, "follow");
  // Whoever brings the scout back needs a new plan: what was planned behind the other choice goes with it.
  EXPECT_THAT(decision->choices[0].activities, UnorderedElementsAre(follow->id, report->id));
  EXPECT_THAT(decision->choices[1].activities, ElementsAre(back->id));
  EXPECT_EQ(temporal::describe(decision->choices[0].rule), "scout.nav = arrived");
  EXPECT_EQ(follow->contingency, "stop");
}

const PlanActivity* find(const FlexiblePlan& plan, const std::string& name) {
  const auto found = std::ranges::find(plan.activities, name, &PlanActivity::name);
  return found == plan.activities.end() ? nullptr : &*found;
}

// Where the scout is brought back the cycle is not done: what says so is skipped with what was planned behind.
TEST(OpenDecisions, WhatADecisionMayLeaveUndoneIsNotTakenForDone) {
  const std::string done =
      with(with(kTeam, "idle: {kind: default}, cycle: {kind: complex}",
                "idle: {kind: default, observed: {timeline: team}}, cycle: {kind: complex, "
                "observed: {timeline: team}}, done: {kind: default, observed: {timeline: team}}"),
           "[idle <-> cycle]", "[idle -> cycle, cycle -> done, done -> cycle]");
  const auto ends_with = [](const PlanActivity& activity) {
    for (const auto& impact : activity.impacts)
      if (impact.moment == temporal::ImpactWhen::at_end) return temporal::to_text(impact.amount);
    return std::string();
  };
  const FlexiblePlan left = *planned(model_of({done})).plan;
  ASSERT_TRUE(find(left, "team.done") && find(left, "team.cycle"));
  EXPECT_EQ(ends_with(*find(left, "team.cycle")), "idle") << "as before it";
  EXPECT_EQ(ends_with(*find(left, "team.done")), "done");
  const auto& go_on = left.decisions[1];
  EXPECT_THAT(go_on.choices[0].activities, Contains(find(left, "team.done")->id));
  EXPECT_THAT(go_on.choices[1].activities, ElementsAre(find(left, "scout.come_back")->id));
  // A choice that brings about the same leaves nothing undone, and the plan goes on behind it.
  const FlexiblePlan same =
      *planned(model_of({with(done, "{subgoals: back}", "{subgoals: back, instead: true}")})).plan;
  EXPECT_EQ(find(same, "team.done"), nullptr);
  EXPECT_EQ(ends_with(*find(same, "team.cycle")), "done");
  const auto& either = same.decisions[1];
  EXPECT_THAT(either.choices[1].activities, Contains(find(same, "primary.report")->id));
  EXPECT_THAT(either.choices[1].activities, Contains(find(same, "scout.come_back")->id));
  EXPECT_THAT(either.choices[1].activities, Not(Contains(find(same, "primary.follow")->id)));
}

TEST(OpenDecisions, TheTimelinesShowTheFirstChoice) {
  const auto result = planned(model_of({kTeam}));
  std::vector<std::string> values;
  for (const auto& token : result.plan->tokens)
    if (token.timeline == "scout") values.push_back(temporal::to_text(token.held));
  EXPECT_THAT(values, ElementsAre("idle", "explore(north)", "idle"));
}

TEST(OpenDecisions, AVariableStaysOpenForAllThatFulfilItsTests) {
  const auto result = planned(model_of({kTeam}));
  const auto decision =
      std::ranges::find_if(result.plan->decisions, [](const auto& one) { return one.choices.empty(); });
  ASSERT_NE(decision, result.plan->decisions.end());
  const auto* explore = result.find("scout.explore(north)");
  ASSERT_TRUE(explore);
  EXPECT_THAT(decision->bindings, ElementsAre(temporal::ArgumentBinding{explore->id, "route"}));
  EXPECT_THAT(decision->admissible, ElementsAre("north", "south"));
  EXPECT_EQ(explore->duration_lower, seconds(10));  // of north
  EXPECT_EQ(explore->duration_upper, seconds(80));  // of south
}

}  // namespace
}  // namespace roci::planner::timeline_htn::extraction
