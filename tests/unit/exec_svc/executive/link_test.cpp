// An owner behind a link that loses commands, cancels and answers: it is asked what became of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exec_svc/executive/executive.hpp"
#include "tests/unit/exec_svc/executive/plan_builder.hpp"

namespace roci::exec::testing {

using executive::Command;
using executive::CommandAck;
using executive::CommandAction;
using executive::CommandStage;
using executive::Contingency;
using executive::Executive;
using executive::ExecutiveSettings;
using executive::OutcomeKind;
using executive::Outputs;
using temporal::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

namespace {

// Five seconds for an answer, and ten for the light there and back.
ExecutiveSettings behind_a_link() {
  ExecutiveSettings settings;
  settings.round_trips["sim"] = seconds(10);
  return settings;
}

class BehindALink : public ::testing::Test {
 protected:
  explicit BehindALink(const ExecutiveSettings& settings = behind_a_link()) : executive(settings) {}

  void load() { EXPECT_THAT(executive.load(plan.plan, seconds(0)), IsEmpty()); }

  std::vector<std::string> step(double at, std::vector<CommandAck> acks = {}) {
    const Outputs out = executive.step(seconds(at), {.acks = std::move(acks)});
    wake = out.next_wake;
    return texts(out);
  }
  static std::vector<std::string> texts(const Outputs& out) {
    std::vector<std::string> commands;
    for (const Command& command : out.commands) {
      const char* action = command.action == CommandAction::execute  ? "execute "
                           : command.action == CommandAction::cancel ? "cancel "
                                                                     : "query ";
      commands.push_back(action + command.activity + "#" + std::to_string(command.attempt));
    }
    return commands;
  }
  static CommandAck ack(CommandStage stage, const std::string& activity = "drive") {
    return {activity, 1, stage, "", ""};
  }

  PlanBuilder plan;
  Executive executive;
  std::optional<temporal::Time> wake;
};

TEST_F(BehindALink, ALostCommandIsAskedForAndSentAgainUnderItsKey) {
  plan.activity("drive", "sim", 100);
  load();
  EXPECT_THAT(step(0), ElementsAre("execute drive#1"));
  EXPECT_EQ(wake, seconds(15));
  EXPECT_THAT(step(14.999), IsEmpty());
  EXPECT_THAT(step(15), ElementsAre("query drive#1"));
  EXPECT_THAT(step(30), ElementsAre("query drive#1")) << "the query may be lost, too";
  EXPECT_THAT(step(40, {ack(CommandStage::unknown)}), ElementsAre("execute drive#1"));
  EXPECT_THAT(step(50, {ack(CommandStage::accepted)}), IsEmpty());
  EXPECT_THAT(step(150, {ack(CommandStage::completed)}), IsEmpty());
  EXPECT_EQ(executive.outcome().kind, OutcomeKind::finished);
}

TEST_F(BehindALink, ALostAnswerIsGivenAgain) {
  plan.activity("drive", "sim", 100);
  load();
  step(0);
  EXPECT_THAT(step(15), ElementsAre("query drive#1"));
  EXPECT_THAT(step(25, {ack(CommandStage::completed)}), IsEmpty());
  EXPECT_EQ(executive.outcome().kind, OutcomeKind::finished);
}

TEST_F(BehindALink, WhoNeverAnswersIsAskedABoundedNumberOfTimes) {
  plan.activity("drive", "sim", 1000);
  load();
  step(0);
  for (int i = 1; i <= 5; ++i) EXPECT_THAT(step(15 * i), ElementsAre("query drive#1"));
  EXPECT_THAT(step(90), ElementsAre("cancel drive#1"));
  EXPECT_EQ(executive.outcome().kind, OutcomeKind::broken);
}

TEST_F(BehindALink, ALostCancelIsSentAgainWhenItsOwnerStillWorks) {
  plan.activity("drive", "sim", 1000);
  load();
  step(0);
  step(10, {ack(CommandStage::accepted)});
  EXPECT_THAT(texts(executive.cancel_all(seconds(20))), ElementsAre("cancel drive#1"));
  EXPECT_THAT(step(34.999), IsEmpty());
  EXPECT_THAT(step(35), ElementsAre("query drive#1"));
  EXPECT_THAT(step(45, {ack(CommandStage::accepted)}), ElementsAre("cancel drive#1"));
  EXPECT_THAT(step(55, {ack(CommandStage::cancelled)}), IsEmpty());
  EXPECT_EQ(executive.outcome().kind, OutcomeKind::cancelled);
}

ExecutiveSettings with_a_contingency() {
  ExecutiveSettings settings = behind_a_link();
  Contingency& back_off = settings.contingencies["back-off"];
  back_off.name = "back-off";
  back_off.commands = {{"sim", "nav", "stop", {}}};
  back_off.retries = true;
  back_off.within = seconds(60);
  return settings;
}

class ContingencyBehindALink : public BehindALink {
 protected:
  ContingencyBehindALink() : BehindALink(with_a_contingency()) {}
};

TEST_F(ContingencyBehindALink, ItsLostCommandIsAskedFor) {
  plan.activity("drive", "sim", 100).contingency = "back-off";
  load();
  step(0);
  step(10, {ack(CommandStage::accepted)});
  EXPECT_THAT(step(20, {ack(CommandStage::failed)}), ElementsAre("execute drive.c1-stop#1"));
  EXPECT_THAT(step(35), ElementsAre("query drive.c1-stop#1"));
  EXPECT_THAT(step(45, {ack(CommandStage::unknown, "drive.c1-stop")}),
              ElementsAre("execute drive.c1-stop#1"));
  EXPECT_THAT(step(55, {ack(CommandStage::completed, "drive.c1-stop")}), ElementsAre("execute drive#2"));
}

}  // namespace
}  // namespace roci::exec::testing
