// An owner that runs for years forgets the oldest ended commands, and yet carries none of them out a second time.
#include "services/owner/retention.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "services/owner/command_ledger.hpp"
#include "services/owner/ledger_file.hpp"

namespace roci::services::owner {
namespace {

using temporal::seconds;
using Order = Reception::Order;

constexpr std::size_t kMany = 5 * Retention::kKept;
constexpr std::uint32_t kPlans = 50;

Request drive(std::size_t number, std::uint32_t plan, Action action = Action::execute) {
  Request out{{"p" + std::to_string(plan) + "." + std::to_string(number) + "-drive", 1, "exec_svc", 1},
              action,
              1,
              "exec_svc",
              "rover",
              "nav",
              "drive"};
  out.plan = plan;
  return out;
}
std::uint32_t plan_of(std::size_t number) { return static_cast<std::uint32_t>(1 + number * kPlans / kMany); }

void fly(CommandLedger& ledger, const Request& request) {
  ASSERT_EQ(ledger.receive(request, seconds(1)).order, Order::carry_out) << request.key.activity;
  ASSERT_TRUE(ledger.say(request.key, {Stage::accepted}, seconds(1)));
  ASSERT_TRUE(ledger.say(request.key, {Stage::completed, "done"}, seconds(2)));
}

CommandLedger after_many() {
  CommandLedger ledger;
  for (std::size_t i = 0; i < kMany; ++i) fly(ledger, drive(i, plan_of(i)));
  return ledger;
}

void expect_none_taken_again(CommandLedger& ledger) {
  std::size_t forgotten = 0;
  for (std::size_t i = 0; i < kMany; ++i) {
    for (const Action action : {Action::query, Action::execute}) {
      const Reception again = ledger.receive(drive(i, plan_of(i), action), seconds(3));
      ASSERT_EQ(again.order, Order::nothing) << i;
      ASSERT_TRUE(again.ack);
      ASSERT_NE(again.ack->status.stage, Stage::unknown) << "its commander would send it again";
      const bool is_old = again.ack->status.code == "forgotten";
      if (is_old) {
        EXPECT_EQ(again.ack->status.stage, Stage::failed);
      }
      forgotten += is_old;
    }
    if (i + Retention::kKept >= kMany) {
      EXPECT_EQ(ledger.receive(drive(i, plan_of(i), Action::query), seconds(3)).ack->status.code, "done")
          << i;
    }
  }
  EXPECT_GT(forgotten, kMany);
}

TEST(Retention, WhatIsKeptIsBoundedAndNothingForgottenIsTakenAgain) {
  CommandLedger ledger = after_many();
  EXPECT_LE(ledger.kept().size(), 4 * Retention::kKept + 10);
  expect_none_taken_again(ledger);
  fly(ledger, drive(kMany, kPlans));
  fly(ledger, drive(kMany, kPlans + 1));
}

TEST(Retention, TheFileKeepsWhatIsForgotten) {
  const auto path = std::filesystem::temp_directory_path() / ("roci_retention_" + std::to_string(::getpid()));
  {
    LedgerFile file(path);
    file.replace(after_many().kept());
    file.append({{"x", 1, "other", 0}, "other", 3});
  }
  CommandLedger ledger;
  for (const LedgerEntry& entry : LedgerFile(path).read()) ledger.restore(entry);
  std::filesystem::remove(path);
  ledger.end_restored();
  expect_none_taken_again(ledger);
  Request old = drive(kMany, kPlans);
  old.epoch = 0;
  EXPECT_EQ(ledger.receive(old, seconds(3)).ack->status.code, "old-epoch")
      << "epochs outlive the file's beginning anew";
}

TEST(Retention, APlanThatRunsForgetsNothing) {
  CommandLedger ledger;
  for (std::size_t i = 0; i < kMany; ++i) fly(ledger, drive(i, 1));
  EXPECT_EQ(ledger.receive(drive(0, 1, Action::query), seconds(3)).ack->status.code, "done");
  EXPECT_EQ(ledger.receive(drive(0, 1), seconds(3)).order, Order::nothing);
}

// Whoever knows the run may stop the robot as often as he likes, under a new key each time.
TEST(Retention, WhatTellsNoPlanIsBoundedToo) {
  constexpr std::size_t kStops = 5 * Retention::kWithoutPlan;
  Retention retention;
  std::vector<CommandKey> forgotten;
  for (std::size_t i = 0; i < kStops; ++i) {
    const CommandKey key{"s" + std::to_string(i), 1, "stranger", 0};
    retention.ended(key, 0, false);
    for (CommandKey& old : retention.take_due()) forgotten.push_back(std::move(old));
    ASSERT_LE(retention.ended().size(), 2 * Retention::kWithoutPlan);
    ASSERT_GE(retention.ended().size(), std::min(i + 1, Retention::kWithoutPlan));
  }
  EXPECT_EQ(forgotten.size() + retention.ended().size(), kStops);
  EXPECT_EQ(forgotten.front().activity, "s0");
  EXPECT_FALSE(retention.forgotten({"new", 1, "stranger", 0}, 0)) << "a new one is not taken for an old one";
}

Request stop(const std::string& activity, const std::string& commander, std::uint64_t issued) {
  Request out{
      {activity, 1, commander, issued}, Action::execute, issued, "stranger", "rover", "nav", kStopCommand};
  out.plan = 1;
  return out;
}

CommandLedger restarted(const CommandLedger& before) {
  CommandLedger after;
  for (const LedgerEntry& entry : before.kept()) after.restore(entry);
  after.end_restored();
  return after;
}

// Its epochs are checked by nobody.
TEST(Retention, AForgedStopMakesNoOtherCommandOld) {
  constexpr std::uint64_t kFar = std::numeric_limits<std::uint64_t>::max();
  for (const char* sender : {"stranger", "exec_svc"}) {
    CommandLedger ledger;
    fly(ledger, drive(0, 1));
    Request forged = stop("s1", "exec_svc", kFar);
    forged.sender = sender;
    fly(ledger, forged);
    Request foreign = drive(1, 1);
    foreign.key.issued_epoch = foreign.epoch = 2;
    foreign.sender = "stranger";
    fly(ledger, foreign);
    Request ahead = drive(2, 1);
    ahead.key.issued_epoch = kFar;
    fly(ledger, ahead);
    for (std::size_t i = 3; i < kMany; ++i) fly(ledger, drive(i, 1));
    fly(ledger, drive(kMany, 1));
    CommandLedger after = restarted(ledger);
    for (std::size_t i = 0; i < kMany; ++i) fly(after, drive(2 * kMany + i, 1));
    EXPECT_EQ(after.receive(drive(5, 1), seconds(3)).ack->status.code, "done");
  }
}

TEST(Retention, NoCommanderOfStopsIsKeptForGood) {
  CommandLedger ledger = after_many();
  for (std::size_t i = 0; i < kMany; ++i)
    for (const std::uint64_t issued : {1, 2}) fly(ledger, stop("s", "c" + std::to_string(i), issued));
  const auto is_mark = [](const LedgerEntry& entry) { return entry.kind == LedgerEntry::Kind::forgotten; };
  EXPECT_EQ(std::ranges::count_if(ledger.kept(), is_mark), 1) << "that of exec_svc";
}

TEST(Retention, StopsThatTellAPlanAreBoundedToo) {
  CommandLedger ledger;
  fly(ledger, drive(0, 1));
  for (std::size_t i = 0; i < 3 * Retention::kWithoutPlan; ++i)
    fly(ledger, stop("s" + std::to_string(i), "exec_svc", 1));
  EXPECT_LE(ledger.kept().size(), 4 * Retention::kWithoutPlan + 10);
  EXPECT_EQ(ledger.receive(drive(0, 1, Action::query), seconds(3)).ack->status.code, "done");
}

TEST(Retention, ALaterEpochBeginsItsPlansAnew) {
  CommandLedger ledger = after_many();
  Request later = drive(0, 1);
  later.key.issued_epoch = later.epoch = 2;
  fly(ledger, later);
}

TEST(Retention, WhatRunsIsNeverForgotten) {
  CommandLedger ledger;
  const Request first = drive(kMany + 1, 1);
  ASSERT_EQ(ledger.receive(first, seconds(1)).order, Order::carry_out);
  ASSERT_TRUE(ledger.say(first.key, {Stage::accepted}, seconds(1)));
  for (std::size_t i = 0; i < kMany; ++i) fly(ledger, drive(i, plan_of(i)));
  EXPECT_TRUE(ledger.say(first.key, {Stage::completed, "done"}, seconds(9)));
  EXPECT_EQ(ledger.receive(drive(kMany + 1, 1, Action::query), seconds(9)).ack->status.code, "done");
}

TEST(Retention, AStopIsObeyedHoweverOldItsKeySeems) {
  CommandLedger ledger = after_many();
  Request stop = drive(0, 0);
  stop.key = {"s1", 1, "exec_svc", 0};
  stop.command = kStopCommand;
  EXPECT_EQ(ledger.receive(stop, seconds(3)).order, Order::carry_out);
  Request fallback = stop;
  fallback.key.activity = "fallback.0.1.nav";
  fallback.command = "stow";
  EXPECT_EQ(ledger.receive(fallback, seconds(3)).ack->status.code, "forgotten");
}

}  // namespace
}  // namespace roci::services::owner
