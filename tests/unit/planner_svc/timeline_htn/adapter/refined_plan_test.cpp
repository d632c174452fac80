// Which way-point comes next stays open (R131): the plan reckons with one, and an answer that names another refines it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "planner_svc/timeline_htn/adapter/timeline_engine.hpp"
#include "planner_svc/timeline_htn/adapter/timeline_resolver.hpp"
#include "planner_svc/timeline_htn/checking/check.hpp"
#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::adapter {
namespace {

using temporal::DecisionPoint, temporal::FlexiblePlan, temporal::PlanActivity, temporal::state;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kTour = R"yaml(domain: tour
types: [place]
objects: {place: [a, b, c, e, d]}
relations:
  leg: {arguments: [place, place], rows: [[a, b], [a, c], [a, e], [b, d], [c, d], [e, d]]}
components:
  tour:
    layer: abstract
    states:
      idle: {kind: default, observed: {timeline: tour}}
      going: {kind: complex, parameters: {from: place, to: place}}
      gone: {kind: default, parameters: {to: place}, observed: {timeline: tour}}
    transitions: ["idle -> going(x, y)", "going(x, y) -> gone(y)"]
  way:
    layer: abstract
    states:
      open: {kind: default, observed: {timeline: way}}
      choosing: {kind: simple, parameters: {next: place}, duration_s: [0, 1]}
      towards: {kind: default, parameters: {next: place}, observed: {timeline: way}}
    transitions: ["open -> choosing(x)", "choosing(x) -> towards(x)", "towards(x) -> choosing(y)"]
  stone:
    layer: primitive
    states: {none: {kind: default, observed: {timeline: stone}}, on: {kind: default, parameters: {place: place}, observed: {timeline: stone}}}
    transitions: []
  base:
    layer: primitive
    states:
      at: {kind: default, parameters: {place: place}, observed: {timeline: nav}}
      drive: {kind: simple, parameters: {from: place, to: place}, duration_s: [10, 30], command: {owner: o, component: b, command: drive}}
    transitions: ["at(x) -> drive(x, y)", "drive(x, y) -> at(y)"]
behaviours:
  as_decided:
    achieves: tour.going(from, to)
    priority: 2
    variables: {next: place}
    where: ["leg(from, next)", "next != to"]
    conditions: [base.at(from), way.towards(next)]
    subgoals: {drive: "base.drive(from, next)", rest: "tour.going(next, to)"}
    constraints: [drive before rest]
  goes_on:
    achieves: tour.going(from, to)
    variables: {next: place}
    where: ["leg(from, next)", "next != to"]
    conditions: [base.at(from), not stone.on(next)]
    subgoals: {note: way.choosing(next), drive: "base.drive(from, next)", rest: "tour.going(next, to)"}
    constraints: [note before drive before rest]
    decisions: {next: {resolver: engine, before: note.start, over: next, subgoals: note}}
  arrives:
    achieves: tour.going(from, to)
    priority: 1
    where: ["leg(from, to)"]
    subgoals: {drive: "base.drive(from, to)"}
problem:
  horizon_s: 1000
  initial: {tour: idle, way: open, stone: none, base: at(a)}
  goals: {there: "tour.gone(d)"}
)yaml";

std::vector<std::string> names(const FlexiblePlan& plan, const std::vector<std::string>& ids) {
  std::vector<std::string> out;
  for (const PlanActivity& activity : plan.activities)
    if (std::ranges::find(ids, activity.id) != ids.end()) out.push_back(activity.name);
  return out;
}

const PlanActivity& activity(const FlexiblePlan& plan, const std::string& name) {
  return *std::ranges::find(plan.activities, name, &PlanActivity::name);
}

TEST(RefinedPlan, ThePlanReckonsWithOneWayAndLeavesTheOthersOpen) {
  const model::Model model = model_of({kTour});
  const FlexiblePlan plan = *planned(model).plan;
  EXPECT_THAT(checking::faults(model, plan), IsEmpty());
  ASSERT_EQ(plan.decisions.size(), 1U);
  const DecisionPoint& next = plan.decisions[0];
  ASSERT_EQ(next.choices.size(), 3U);
  EXPECT_EQ(next.choices[0].name, "b");
  EXPECT_THAT(names(plan, next.choices[0].activities),
              testing::UnorderedElementsAre("way.choosing(b)", "base.drive(a, b)", "tour.going(b, d)",
                                            "base.drive(b, d)", "tour.gone(d)"))
      << "the last says what has come of it";
  EXPECT_EQ(next.choices[1].name, "c");
  EXPECT_THAT(names(plan, next.choices[1].activities), ElementsAre("way.choosing(c)"));
  ASSERT_EQ(activity(plan, "way.choosing(c)").impacts.size(), 1U);
  EXPECT_EQ(temporal::to_text(activity(plan, "way.choosing(c)").impacts[0].amount), "towards(c)");
  EXPECT_EQ(next.choices[2].name, "e");
}

TEST(RefinedPlan, TheCheckerRefusesADecisionThatIsNotTheBehaviours) {
  const model::Model model = model_of({kTour});
  const FlexiblePlan sound = *planned(model).plan;
  const auto after = [&](const std::function<void(FlexiblePlan&, DecisionPoint&)>& harm) {
    FlexiblePlan plan = sound;
    harm(plan, plan.decisions[0]);
    return checking::faults(model, plan);
  };
  EXPECT_THAT(after([](auto&, auto& next) { next.choices.pop_back(); }), Not(IsEmpty()));
  EXPECT_THAT(after([](auto&, auto& next) { next.choices[1].name = "d"; }),
              Contains(HasSubstr("choice 'd' is none of the behaviour")));
  EXPECT_THAT(after([](auto&, auto& next) { std::swap(next.choices[0].name, next.choices[1].name); }),
              Contains(HasSubstr("its first choice is not the one that the plan reckons with")));
  EXPECT_THAT(
      after([](auto&, auto& next) { std::swap(next.choices[1].activities, next.choices[2].activities); }),
      Contains(HasSubstr("has not just the activities of the behaviour for that object")));
  EXPECT_THAT(after([](auto& plan, auto& next) {
                const auto point = activity(plan, "way.choosing(c)").start_point;
                std::erase_if(plan.constraints, [&](const auto& one) {
                  return std::minmax(one.from_point, one.to_point) == std::minmax(next.decide_before, point);
                });
              }),
              Contains(HasSubstr("choice 'c' may begin before it is decided")));
  EXPECT_THAT(after([](auto& plan, auto&) {
                const auto mark = activity(plan, "tour.gone(d)");
                std::ranges::find(plan.activities, "tour.going(a, d)", &PlanActivity::name)->impacts =
                    mark.impacts;
              }),
              Contains(HasSubstr("whatever is decided, tour.going(a, d) ends with tour.gone(d)")));
  EXPECT_THAT(after([](auto& plan, auto&) { plan.decisions.clear(); }), Not(IsEmpty()));
}

// What the choice has left is seen, and the next plan begins from there: nothing is asked a second time.
TEST(RefinedPlan, TheNextPlanGoesTheWayThatWasDecided) {
  engine::Request request;
  request.engine = "timeline_htn";
  request.model = kTour;
  request.state = {{"nav", state("at", {"a"})}, {"way", state("towards", {"c"})}, {"stone", state("none")}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "1";
  goal.achieved = temporal::compare("tour", temporal::ConditionOp::eq, state("gone", {"d"}));
  request.goals = {goal};
  engine::NoFunctions functions;
  const engine::Answer answer = TimelineEngine().answer(request, {}, functions);
  ASSERT_TRUE(answer.plan) << answer.reason;
  EXPECT_EQ(answer.plan->activities.size(), 4U);
  EXPECT_EQ(activity(*answer.plan, "base.drive(a, c)").name, "base.drive(a, c)");
  EXPECT_THAT(answer.plan->decisions, IsEmpty());
}

TEST(RefinedPlan, TheEngineDecidesOnTheFirstWayThatIsOpen) {
  const FlexiblePlan plan = *planned(model_of({kTour})).plan;
  engine::Request request;
  request.model = kTour;
  const auto answer = [&] {
    const auto out = TimelineResolver().resolve({request, plan, plan.decisions[0]});
    return out ? out->choice : "";
  };
  request.state = {{"nav", state("at", {"a"})}, {"way", state("open")}, {"stone", state("none")}};
  EXPECT_EQ(answer(), "b");
  request.state["stone"] = state("on", {"b"});
  EXPECT_EQ(answer(), "c");
  request.model = with(kTour, "[c, d]", "[c, c]");
  EXPECT_EQ(answer(), "e") << "no way leads on from c";
}

// As it is flown (scenario_courier).
TEST(RefinedPlan, TheCourierGoesWhereTheDoorIsNotShut) {
  engine::Request request;
  request.engine = "timeline_htn";
  request.model = text_of_file("tests/missions/courier/courier.yaml");
  request.state = {{"courier.base", state("parked", {"dock"})},
                   {"courier.eye", state("blind")},
                   {"errand", state("idle")}};
  engine::Goal goal;
  goal.issuer = "ground";
  goal.id = "1";
  goal.achieved = temporal::compare("errand", temporal::ConditionOp::eq, state("brought", {"hall"}));
  request.goals = {goal};
  engine::NoFunctions functions;
  const engine::Answer answer = TimelineEngine().answer(request, {}, functions);
  ASSERT_TRUE(answer.plan) << answer.reason;
  request.goals.clear();
  request.state["courier.eye"] = state("shut", {"north"});
  const auto out = TimelineResolver().resolve({request, *answer.plan, answer.plan->decisions.at(0)});
  ASSERT_TRUE(out);
  EXPECT_EQ(out->choice, "south");
}

TEST(RefinedPlan, WhatCannotBeDecidedIsTold) {
  const auto faults = [](const std::string& from, const std::string& to) {
    mission::Findings findings;
    reading::parse_model({{"m.yaml", with(kTour, from, to)}}, findings);
    return reading::errors_of(findings);
  };
  EXPECT_THAT(faults("over: next, subgoals: note", "over: next, subgoals: rest"), HasSubstr("is not simple"));
  EXPECT_THAT(faults("over: next, subgoals: note", "over: to, subgoals: note"),
              HasSubstr("decision 'next' is over 'to', which it achieves"));
  EXPECT_THAT(faults("over: next, subgoals: note", "over: nowhere, subgoals: note"),
              HasSubstr("'nowhere' is no variable of the behaviour"));
  EXPECT_THAT(faults("over: next, subgoals: note", "over: next"), HasSubstr("subgoals"));
  EXPECT_THAT(faults("over: next, subgoals: note", "binds: next, subgoals: note"),
              HasSubstr("take them out"));
  EXPECT_THAT(faults("resolver: engine", "resolver: rule"), HasSubstr("a rule picks among choices"));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::adapter
