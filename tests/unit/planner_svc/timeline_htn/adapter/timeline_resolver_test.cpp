// Decisions that a running plan leaves to the engine: answered from what is seen when they are due (R131).
#include "planner_svc/timeline_htn/adapter/timeline_resolver.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planner_svc/timeline_htn/search/plans.hpp"

namespace roci::planner::timeline_htn::adapter {
namespace {

using temporal::DecisionPoint, temporal::FlexiblePlan, temporal::seconds, temporal::state;

const std::string kTeam = R"yaml(domain: team
types: [place]
objects: {place: [a, b, c]}
components:
  team:
    layer: abstract
    states: {idle: {kind: default, observed: {timeline: team}}, cycle: {kind: complex, parameters: {from: place, to: place}, observed: {timeline: team}}}
    transitions: ["idle <-> cycle(x, y)"]
  pair:
    layer: abstract
    states: {idle: {kind: default}, following: {kind: complex, parameters: {from: place, to: place}}}
    transitions: ["idle <-> following(x, y)"]
  scout:
    layer: primitive
    states:
      at: {kind: default, parameters: {place: place}, observed: {timeline: scout.nav}}
      drive: {kind: simple, parameters: {from: place, to: place}, duration_s: [10, 30], command: {owner: o, component: s, command: drive, arguments: {to: to}}, observed: {timeline: scout.nav, value: driving}}
      back: {kind: simple, parameters: {from: place, to: place}, duration_s: [10, 30], command: {owner: o, component: s, command: back}}
      lost: {kind: error, observed: {timeline: scout.nav}}
    transitions: ["at(x) -> drive(x, y), back(x, y)", "drive(x, y) -> at(y)", "back(x, y) -> at(y)"]
  primary:
    layer: primitive
    states:
      at: {kind: default, parameters: {place: place}, observed: {timeline: primary.nav}}
      follow: {kind: simple, parameters: {from: place, to: place}, duration_s: [10, 30], command: {owner: o, component: p, command: follow}}
      blocked: {kind: error, parameters: {place: place}, observed: {timeline: primary.nav}}
    transitions: ["at(x) -> follow(x, y)", "follow(x, y) -> at(y)"]
  drill:
    layer: primitive
    states:
      up: {kind: default}
      drill: {kind: simple, parameters: {place: place}, duration_s: 5, command: {owner: o, component: d, command: drill, arguments: {at: place}}, needs: ["during cover.off(place)"]}
    transitions: ["up <-> drill(x)"]
  cover:
    layer: primitive
    states:
      off: {kind: default, parameters: {place: place}, observed: {timeline: cover}}
      move: {kind: simple, parameters: {from: place, to: place}, duration_s: 5, command: {owner: o, component: c, command: move}}
    transitions: ["off(x) -> move(x, y)", "move(x, y) -> off(y)"]
behaviours:
  cycle:
    achieves: team.cycle(from, to)
    variables: {sample: place}
    conditions: [scout.at(from), primary.at(from)]
    subgoals: {ahead: "scout.drive(from, to)", behind: "pair.following(from, to)", back: "scout.back(to, from)", drill: drill.drill(sample)}
    constraints: [ahead before behind before drill, ahead before back]
    decisions:
      go_on: {resolver: engine, before: behind.start, choices: {follow: {subgoals: behind}, bring_back: {subgoals: back}}}
      where: {resolver: engine, before: drill.start, binds: sample}
  follow:
    achieves: pair.following(from, to)
    conditions: [scout.at(to)]
    subgoals: {drive: "primary.follow(from, to)"}
problem:
  horizon_s: 1000
  initial: {team: idle, pair: idle, scout: at(a), primary: at(a), drill: up, cover: off(a)}
  goals: {g: "team.cycle(a, b)"}
)yaml";

class TimelineResolverTest : public testing::Test {
 protected:
  TimelineResolverTest() {
    plan_ = *planned(model_of({kTeam})).plan;
    rename();
    request_.model = kTeam;
    request_.origin = seconds(40);
    see("team", state("cycle", {"a", "b"}));  // is under way
    see("scout.nav", state("at", {"b"}));
    see("primary.nav", state("at", {"a"}));
    see("cover", state("off", {"a"}));
  }

  void see(const std::string& timeline, const temporal::Value& value) { request_.state[timeline] = value; }

  // As the executive does.
  void rename() {
    std::map<std::string, std::string> ids;
    for (auto& one : plan_.activities) {
      ids[one.id] = "p1." + one.id + "-" + one.name;
      one.id = ids[one.id];
    }
    for (auto& one : plan_.activities)
      if (!one.parent.empty()) one.parent = ids[one.parent];
    for (DecisionPoint& decision : plan_.decisions) {
      decision.id = "p1." + decision.id;
      for (auto& choice : decision.choices)
        for (std::string& id : choice.activities) id = ids[id];
      for (auto& binding : decision.bindings) binding.activity = ids[binding.activity];
    }
  }

  const DecisionPoint& decision(const std::string& name) const {
    return *std::ranges::find_if(plan_.decisions,
                                 [&](const auto& one) { return one.id.ends_with("." + name); });
  }
  // The choice or the value; "": it stays open.
  std::string answer(const std::string& name) const {
    const auto resolution = TimelineResolver().resolve({request_, plan_, decision(name)});
    return resolution ? resolution->choice + resolution->value : "";
  }

  FlexiblePlan plan_;
  engine::Request request_;
};

TEST_F(TimelineResolverTest, WhatWasPlannedOnIsTakenWhereItCanBeCarriedOut) {
  EXPECT_EQ(answer("go_on"), "follow");
}

TEST_F(TimelineResolverTest, TheNextChoiceIsTakenWhereTheFirstCannotBeCarriedOut) {
  see("primary.nav", state("blocked", {"a"}));
  EXPECT_EQ(answer("go_on"), "bring_back");
  see("primary.nav", state("at", {"c"}));
  EXPECT_EQ(answer("go_on"), "bring_back") << "it stands elsewhere";
}

TEST_F(TimelineResolverTest, WhatIsNotSeenLeavesItOpen) {
  see("scout.nav", state("driving"));
  EXPECT_EQ(answer("go_on"), "");
  see("scout.nav", state("floating"));
  EXPECT_EQ(answer("go_on"), "");
  request_.state.erase("scout.nav");
  EXPECT_EQ(answer("go_on"), "");
  see("scout.nav", state("at", {"b"}));
  EXPECT_EQ(answer("go_on"), "follow");
}

// Neither choice can be carried out: the executive says so when the time of the decision is over.
TEST_F(TimelineResolverTest, WhereNothingCanBeCarriedOutItStaysOpen) {
  see("scout.nav", state("lost"));
  EXPECT_EQ(answer("go_on"), "");
  see("scout.nav", state("at", {"a"}));
  EXPECT_EQ(answer("go_on"), "") << "to bring it back it would have to be sent out first";
  see("scout.nav", state("at", {"b"}));
  request_.origin = seconds(2000);
  EXPECT_EQ(answer("go_on"), "") << "the horizon has passed";
}

TEST_F(TimelineResolverTest, NothingIsTriedOnceItIsToStop) {
  std::stop_source source;
  const auto resolve = [&] {
    return TimelineResolver().resolve(
        {.request = request_, .plan = plan_, .decision = decision("go_on"), .stop = source.get_token()});
  };
  EXPECT_TRUE(resolve());
  source.request_stop();
  EXPECT_FALSE(resolve());
}

TEST_F(TimelineResolverTest, AVariableIsBoundToWhatNeedsNoOtherCommands) {
  see("primary.nav", state("at", {"b"}));
  EXPECT_EQ(answer("where"), "a") << "as planned";
  see("cover", state("off", {"c"}));
  EXPECT_EQ(answer("where"), "c");
}

TEST_F(TimelineResolverTest, WhatIsOfNoModelIsToldSo) {
  request_.model += "nonsense: 1\n";
  EXPECT_THROW(answer("go_on"), std::runtime_error);
  request_.model = with(kTeam, "      go_on:", "      other:");
  EXPECT_THROW(answer("go_on"), std::runtime_error);
}

}  // namespace
}  // namespace roci::planner::timeline_htn::adapter
