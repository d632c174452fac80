// Decisions of the running plan (R131): each resolver, answered on time, late, with what is unknown, twice; and
// what an answer does to the plan.
#include "exec_svc/reactor/decision_exchange.hpp"
#include "tests/unit/exec_svc/executive/plan_builder.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec::testing {

using executive::AnswerOutcome;
using executive::Command;
using executive::CommandAction;
using executive::DecisionState;
using reactor::AnswerReceipt;
using reactor::GivenAnswer;
using reactor::Reactor;
using reactor::ReactorInputs;

namespace {

using temporal::CommitState;
using temporal::PlanActivity;
using temporal::ResolverKind;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

GivenAnswer given(const std::string& issuer, const std::string& id, std::uint64_t number,
                  const std::string& decision, const std::string& choice) {
  GivenAnswer answer;
  answer.key.issuer = issuer;
  answer.key.id = id;
  answer.sample.sender = issuer;
  answer.sample.incarnation = 1;
  answer.sample.number = number;
  answer.decision = decision;
  answer.choice = choice;
  return answer;
}

// The camera looks for 40 s; then one of two images is to be taken, which somebody decides before 300 s.
class DecisionTest : public ReactorTest {
 protected:
  DecisionTest() {
    mission.executive.replanning = mission::Replanning::continuous;
    mission.planner.engine = "scripted";
    reactor = Reactor(mission);
    plan.plan.engine = "scripted";
    for (const char* id : {"look", "left", "right"}) image(id);
    plan.after("look", "left");
    plan.after("look", "right");
  }

  void image(const std::string& id) {
    PlanActivity& added = plan.activity(id, "sim_svc", 40);
    added.subsystem = "camera";
    added.command_name = "image";
    added.arguments = {{"image", "image-" + id}};
    added.commit = CommitState::committed;
  }
  temporal::DecisionPoint& ask(ResolverKind kind) {
    temporal::DecisionPoint way{"way", "", {{"by-left", {"left"}}, {"by-right", {"right"}}}, plan.point()};
    way.resolver_kind = kind;
    plan.window(way.decide_before, 0, 300);
    plan.plan.decisions.push_back(way);
    return plan.plan.decisions.back();
  }
  void set_rules() {
    for (temporal::DecisionChoice& choice : plan.plan.decisions.back().choices)
      choice.rule = temporal::compare("rover.way", temporal::ConditionOp::eq, state(choice.name.substr(3)));
  }
  void see_at(double time_s, const std::string& timeline, const temporal::Value& value) {
    other_events.emplace(seconds(time_s), [this, timeline, value] {
      pending.observations.push_back({timeline, value});
    });
  }
  void answer_at(double time_s, const std::string& issuer, const std::string& id, const std::string& decision,
                 const std::string& choice, const std::string& value = "") {
    GivenAnswer answer = given(issuer, id, ++samples, decision, choice);
    answer.value = value;
    other_events.emplace(seconds(time_s), [this, answer] { pending.answers.push_back(answer); });
  }
  void fly(double until_s = 1000) {
    ReactorInputs first = robot_and({photo("1")});
    ++plan.plan.version;
    first.deltas.push_back(difference({}, plan.plan));
    run(until_s, std::move(first));
  }
  std::vector<std::string> begun() const {
    std::vector<std::string> out;
    for (const Command& command : commands)
      if (command.action == CommandAction::execute && command.command_name == "image")
        out.push_back(command.arguments.front().value);
    return out;
  }
  std::vector<AnswerOutcome> outcomes() const {
    std::vector<AnswerOutcome> out;
    for (const AnswerReceipt& receipt : receipts) out.push_back(receipt.result.outcome);
    return out;
  }
  std::vector<DecisionState> states() const {
    std::vector<DecisionState> out;
    for (const auto& [time, decision] : decisions) out.push_back(decision.status.state);
    return out;
  }

  PlanBuilder plan;
  std::uint64_t samples = 0;
};

struct Asked {
  ResolverKind kind;
  const char* who;
};

// Engine and ground: both are asked over the wire.
class AskedResolver : public DecisionTest, public ::testing::WithParamInterface<Asked> {
 protected:
  AskedResolver() { ask(GetParam().kind); }
  const std::string who = GetParam().who;
};

TEST_P(AskedResolver, OnTimeTheAnswerPicksAndTheOthersAreSkipped) {
  answer_at(60, who, "1", "way", "by-right");
  fly();
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-right"));
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::taken));
  ASSERT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::answered));
  EXPECT_EQ(decisions[0].first, 40) << "when what is before it has ended";
  EXPECT_EQ(decisions[0].second.status.resolver, who);
  EXPECT_THAT(decisions[0].second.status.choices, ElementsAre("by-left", "by-right"));
  EXPECT_EQ(decisions[0].second.status.answer_before, seconds(300));
  EXPECT_EQ(decisions[0].second.plan_version, 1U);
  EXPECT_EQ(decisions[1].second.status.chosen, "by-right");
  EXPECT_EQ(decisions[1].second.status.answered_by, who);
  EXPECT_THAT(trace, Contains("plan.finished"));
}

TEST_P(AskedResolver, LateTheDecisionIsMissedAndThePlanBroken) {
  answer_at(310, who, "1", "way", "by-right");
  fly(400);
  EXPECT_THAT(begun(), ElementsAre("image-look"));
  EXPECT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::missed));
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::late));
  EXPECT_THAT(receipts[0].result.reason, HasSubstr("due before 300"));
  EXPECT_THAT(trace, Contains("plan.broken"));
}

TEST_P(AskedResolver, WhatIsUnknownChangesNothing) {
  answer_at(10, who, "0", "way", "by-left");  // nobody has asked yet
  answer_at(50, who, "1", "way", "by-the-moon");
  answer_at(51, who, "2", "lunch", "by-left");
  answer_at(60, who, "3", "way", "by-left");
  fly();
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::unknown_decision, AnswerOutcome::unknown_choice,
                                      AnswerOutcome::unknown_decision, AnswerOutcome::taken));
  EXPECT_THAT(receipts[1].result.reason, HasSubstr("one of: by-left, by-right"));
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-left"));
}

TEST_P(AskedResolver, TwiceTheFirstStands) {
  answer_at(60, who, "1", "way", "by-left");
  answer_at(61, who, "1", "way", "by-right");  // the same id
  answer_at(62, who, "2", "way", "by-right");
  fly();
  EXPECT_THAT(outcomes(),
              ElementsAre(AnswerOutcome::taken, AnswerOutcome::repeated, AnswerOutcome::repeated));
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-left"));
}

TEST_P(AskedResolver, ASampleThatIsHeardAgainIsNoSecondAnswer) {
  answer_at(60, who, "1", "way", "by-left");
  --samples;
  answer_at(61, who, "1", "way", "by-left");
  fly();
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::taken));
}

TEST_P(AskedResolver, NobodyElseIsEntitled) {
  answer_at(60, "somebody", "1", "way", "by-left");
  answer_at(70, who, "1", "way", "by-right");
  fly();
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::not_entitled, AnswerOutcome::taken));
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-right"));
}

INSTANTIATE_TEST_SUITE_P(Resolvers, AskedResolver,
                         ::testing::Values(Asked{ResolverKind::engine, "scripted"},
                                           Asked{ResolverKind::ground, "ground"}),
                         [](const auto& test) { return std::string(test.param.who); });

class Rule : public DecisionTest {
 protected:
  Rule() {
    ask(ResolverKind::rule);
    set_rules();
  }
};

TEST_F(Rule, ThatHoldsWhenTheDecisionIsDuePicksAtOnce) {
  see_at(10, "rover.way", state("right"));
  fly();
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-right"));
  ASSERT_THAT(states(), ElementsAre(DecisionState::answered)) << "nobody is asked";
  EXPECT_EQ(decisions[0].second.status.answered_by, "rule");
}

TEST_F(Rule, ThatHoldsLaterButInTimePicksThen) {
  see_at(100, "rover.way", state("left"));
  see_at(110, "rover.way", state("right"));  // twice: the first stands
  fly();
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-left"));
  ASSERT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::answered));
  EXPECT_EQ(decisions[1].first, 100);
}

TEST_F(Rule, ThatHoldsTooLateBreaksThePlan) {
  see_at(50, "rover.way", state("back"));
  see_at(301, "rover.way", state("right"));
  fly(400);
  EXPECT_THAT(begun(), ElementsAre("image-look"));
  EXPECT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::missed));
  EXPECT_THAT(trace, Contains("plan.broken"));
}

TEST_F(Rule, TheFirstChoiceThatHoldsIsTakenAndOneWithoutConditionAlwaysDoes) {
  plan.plan.decisions.back().choices[1].rule = {};
  fly();
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-right"));
}

TEST_F(Rule, NobodyAnswersInItsPlace) {
  answer_at(60, "ground", "1", "way", "by-left");
  answer_at(61, "rule", "1", "way", "by-left");
  see_at(100, "rover.way", state("right"));
  fly();
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::not_entitled, AnswerOutcome::not_entitled));
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-right"));
}

TEST_F(DecisionTest, AnAnswerBindsAnArgument) {
  temporal::DecisionPoint what{"what", "chief", {}, plan.point()};
  what.resolver_kind = ResolverKind::ground;
  what.bindings = {{"left", "image"}, {"right", "image"}};
  what.admissible = {"image-1", "image-2"};
  plan.plan.decisions.push_back(what);
  plan.after("left", "right");
  answer_at(45, "ground", "1", "what", "", "image-1");  // the chief alone is asked
  answer_at(50, "chief", "1", "what", "", "image-3");
  answer_at(60, "chief", "2", "what", "", "image-1");
  fly();
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-1", "image-1"));
  EXPECT_THAT(outcomes(),
              ElementsAre(AnswerOutcome::not_entitled, AnswerOutcome::unknown_choice, AnswerOutcome::taken));
  EXPECT_EQ(reactor.outcome(), "achieved") << "it is the image that the goal wants";
}

TEST_F(DecisionTest, TheNextVersionOfThePlanKeepsQuestionAndAnswer) {
  ask(ResolverKind::engine);
  temporal::DecisionPoint what{"what", "", {}, plan.point()};
  what.bindings = {{"right", "image"}};
  plan.plan.decisions.push_back(what);
  const auto next_version_at = [this](double time_s) {
    other_events.emplace(seconds(time_s), [this] {
      const temporal::FlexiblePlan before = plan.plan;
      ++plan.plan.version;
      plan.plan.activities[2].utility = {static_cast<double>(plan.plan.version)};
      pending.deltas.push_back(difference(before, plan.plan));
    });
  };
  plan.plan.activities[2].commit = CommitState::planned;
  answer_at(60, "scripted", "1", "what", "", "image-1");
  next_version_at(70);
  answer_at(80, "scripted", "2", "way", "by-right");
  other_events.emplace(seconds(90), [this] {
    const temporal::FlexiblePlan before = plan.plan;
    ++plan.plan.version;
    plan.plan.activities[2].commit = CommitState::committed;
    plan.plan.decisions.erase(plan.plan.decisions.begin());  // with the activity that it left out
    std::erase_if(plan.plan.constraints, [this](const temporal::TemporalConstraint& constraint) {
      return constraint.to_point == plan.start("left");
    });
    plan.plan.activities.erase(plan.plan.activities.begin() + 1);
    pending.deltas.push_back(difference(before, plan.plan));
  });
  fly();
  EXPECT_EQ(reactor.plan_version(), 3U);
  EXPECT_THAT(trace, Not(Contains("plan.refused")));
  EXPECT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::open, DecisionState::answered,
                                    DecisionState::answered));
  EXPECT_THAT(begun(), ElementsAre("image-look", "image-1"));
}

TEST_F(DecisionTest, ThatNoPlanHasAnyMoreIsVoid) {
  ask(ResolverKind::engine);
  for (PlanActivity& activity : plan.plan.activities)
    if (activity.id != "look") activity.commit = CommitState::planned;
  other_events.emplace(seconds(70), [this] {
    PlanBuilder other;
    other.plan.engine = "scripted";
    const temporal::FlexiblePlan before = std::exchange(plan.plan, {});
    plan.plan.engine = "scripted";
    plan.plan.version = before.version + 1;
    image("1");
    pending.deltas.push_back(difference(before, plan.plan));
  });
  answer_at(80, "scripted", "1", "way", "by-left");
  fly();
  EXPECT_THAT(states(), ElementsAre(DecisionState::open, DecisionState::void_));
  EXPECT_THAT(outcomes(), ElementsAre(AnswerOutcome::late));
  EXPECT_THAT(receipts[0].result.reason, HasSubstr("plan 1, which asked for it, no longer runs"));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// A planner's plan gets new ids when it is bound; its decisions follow.
TEST_F(ReactorTest, ADecisionInAPlannersPlanIsAskedForUnderTheIdsOfThePlan) {
  planner = [this](const reactor::PlanRequest& call) {
    reactor::PlanReply out = image_every_goal(call);
    temporal::DecisionPoint way{"way", "", {}, out.plan.point_count++};
    for (const PlanActivity& activity : out.plan.activities)
      way.choices.push_back({"only-" + activity.id, {activity.id}});
    out.plan.constraints.clear();
    way.resolver_kind = ResolverKind::ground;
    out.plan.decisions.push_back(way);
    return out;
  };
  other_events.emplace(
      seconds(60), [this] { pending.answers.push_back(given("ground", "1", 1, "p1.way", "only-asecond")); });
  run(90, robot_and({photo("first"), photo("second")}));
  ASSERT_EQ(receipts.size(), 1U);
  EXPECT_EQ(receipts[0].result.outcome, AnswerOutcome::taken) << receipts[0].result.reason;
  ASSERT_FALSE(commands.empty());
  EXPECT_EQ(commands.front().arguments.front().value, "image-second");
}

// A mission of months asks again with each plan.
TEST(DecisionExchange, KeepsWhatIsOpenAndTheNewestOfWhatIsClosed) {
  constexpr std::uint32_t kAsked = 3'000;
  reactor::DecisionExchange exchange;
  const auto change = [&exchange](std::uint32_t plan, DecisionState state) {
    reactor::DecisionRecord record;
    record.status.decision = "p" + std::to_string(plan) + ".route";
    record.status.resolver = "ground";
    record.status.state = state;
    record.plan_version = plan;
    std::vector<reactor::DecisionRecord> changes{record};
    exchange.note_changes(changes);
  };
  change(1, DecisionState::open);
  for (std::uint32_t plan = 2; plan <= kAsked; ++plan) {
    change(plan, DecisionState::open);
    change(plan, DecisionState::answered);
  }
  const auto& kept = exchange.decisions();
  EXPECT_EQ(kept.size(), reactor::DecisionExchange::kClosedDecisions + 1);
  EXPECT_TRUE(kept.contains("p1.route")) << "it is open";
  EXPECT_FALSE(kept.contains("p2.route"));
  EXPECT_FALSE(kept.contains("p2000.route"));
  EXPECT_TRUE(kept.contains("p2001.route"));
  EXPECT_TRUE(kept.contains("p3000.route"));
}

}  // namespace
}  // namespace roci::exec::testing
