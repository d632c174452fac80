#include "services/owner/command_ledger.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::services::owner {

using temporal::seconds;

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Order = Reception::Order;

Request request(const std::string& activity, Action action = Action::execute, std::uint64_t epoch = 1,
                const std::string& commander = "") {
  return {{activity, 1, commander}, action, epoch, commander, "", "drill", "bore"};
}

// A ledger that has accepted "a" at 1 s.
CommandLedger with_running(std::optional<temporal::Time> latest_end = std::nullopt) {
  CommandLedger ledger;
  Request bore = request("a");
  bore.latest_end = latest_end;
  EXPECT_EQ(ledger.receive(bore, seconds(1)).order, Order::carry_out);
  EXPECT_TRUE(ledger.say(bore.key, {Stage::accepted}, seconds(1)));
  return ledger;
}

const CommandKey kA{"a", 1};

TEST(CommandLedger, AKeyIsTakenOnceAndItsLastWordRepeated) {
  CommandLedger ledger = with_running();
  const Reception again = ledger.receive(request("a"), seconds(2));
  EXPECT_EQ(again.order, Order::nothing);
  EXPECT_EQ(again.ack->status.stage, Stage::accepted);
  const auto done = ledger.say(kA, {Stage::completed, "done"}, seconds(9));
  const Reception late = ledger.receive(request("a"), seconds(20));
  EXPECT_EQ(late.order, Order::nothing);
  EXPECT_EQ(late.ack->status, done->status);
  EXPECT_EQ(late.ack->at, seconds(20));
}

TEST(CommandLedger, WhatRepeatsACommandWithoutAWordWaitsForTheWord) {
  CommandLedger ledger;
  EXPECT_EQ(ledger.receive(request("a"), seconds(1)).order, Order::carry_out);
  const Reception again = ledger.receive(request("a"), seconds(2));
  EXPECT_EQ(again.order, Order::nothing);
  EXPECT_FALSE(again.ack);
  EXPECT_EQ(ledger.receive(request("a", Action::query), seconds(2)).ack->status.stage, Stage::accepted);
}

TEST(CommandLedger, AttemptsCommandersAndEpochsOfIssueMakeDifferentKeys) {
  CommandLedger ledger;
  for (const CommandKey& key : std::vector<CommandKey>{{"a", 1}, {"a", 2}, {"a", 1, "e"}, {"a", 1, "e", 7}}) {
    Request one = request("a", Action::execute, 9);
    one.key = key;
    EXPECT_EQ(ledger.receive(one, seconds(1)).order, Order::carry_out);
  }
}

TEST(CommandLedger, AQueryGetsTheLastWord) {
  CommandLedger ledger = with_running();
  EXPECT_EQ(ledger.receive(request("a", Action::query), seconds(2)).ack->status.stage, Stage::accepted);
  ledger.say(kA, {Stage::failed, "jammed", "in hard rock"}, seconds(3));
  const Ack ack = *ledger.receive(request("a", Action::query), seconds(4)).ack;
  EXPECT_EQ(ack.status.stage, Stage::failed);
  EXPECT_EQ(ack.status.code, "jammed");
  const Ack unknown = *ledger.receive(request("b", Action::query), seconds(4)).ack;
  EXPECT_EQ(unknown.status.stage, Stage::unknown);
  EXPECT_EQ(unknown.status.code, "unknown-key");
}

TEST(CommandLedger, EpochsAreCountedByCommander) {
  CommandLedger ledger;
  EXPECT_EQ(ledger.receive(request("a", Action::execute, 5, "first"), seconds(1)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(request("b", Action::execute, 1, "second"), seconds(1)).order, Order::carry_out);
  const Ack refused = *ledger.receive(request("c", Action::execute, 4, "first"), seconds(2)).ack;
  EXPECT_EQ(refused.status.stage, Stage::rejected);
  EXPECT_EQ(refused.status.code, "old-epoch");
  EXPECT_TRUE(refused.refused_epoch);
  EXPECT_EQ(refused.newest_epoch, 5u);
  EXPECT_THAT(refused.status.reason, HasSubstr("epoch 4 is over"));
  EXPECT_EQ(ledger.receive(request("c", Action::execute, 5, "first"), seconds(3)).order, Order::carry_out)
      << "a refused request does not take the key";
  EXPECT_EQ(ledger.receive(request("d", Action::execute, 1, "second"), seconds(3)).order, Order::carry_out);
}

// Who takes over asks under the old key, and is counted by its own epochs.
TEST(CommandLedger, ASuccessorCancelsWhatAnotherCommanded) {
  CommandLedger ledger;
  const Request bore = request("a", Action::execute, 5, "first");
  ledger.receive(bore, seconds(1));
  ledger.say(bore.key, {Stage::accepted}, seconds(1));
  Request cancel = request("a", Action::cancel, 2, "first");
  cancel.sender = "second";
  EXPECT_EQ(ledger.receive(cancel, seconds(2)).order, Order::break_off);
  EXPECT_EQ(ledger.say(bore.key, {Stage::cancelled}, seconds(2))->newest_epoch, 5u);
  cancel.epoch = 1;
  EXPECT_TRUE(ledger.receive(cancel, seconds(3)).ack->refused_epoch) << "that one is counted now, too";
}

TEST(CommandLedger, AnOlderEpochMayNeitherAskNorCancel) {
  CommandLedger ledger = with_running();
  ledger.receive(request("x", Action::execute, 3), seconds(2));
  for (const Action action : {Action::query, Action::cancel}) {
    const Reception old = ledger.receive(request("a", action, 2), seconds(3));
    EXPECT_EQ(old.order, Order::nothing);
    EXPECT_EQ(old.ack->status.code, "old-epoch");
  }
}

Request of_process(Request one, std::uint32_t incarnation, std::uint64_t number) {
  one.incarnation = incarnation;
  one.number = number;
  return one;
}

TEST(CommandLedger, NoQueryRaisesAnEpoch) {
  CommandLedger ledger = with_running();
  EXPECT_EQ(ledger.receive(request("a", Action::query, 1'000'000), seconds(2)).ack->status.stage,
            Stage::accepted);
  EXPECT_EQ(ledger.receive(request("z", Action::cancel, 500), seconds(2)).ack->status.stage, Stage::unknown)
      << "nothing was cancelled";
  EXPECT_EQ(ledger.receive(request("b"), seconds(3)).order, Order::carry_out)
      << "epoch 1 is still the newest";
}

TEST(CommandLedger, ACommandTakesNoWideStep) {
  CommandLedger ledger = with_running();
  const Reception wide = ledger.receive(request("b", Action::execute, 1 + kEpochJump + 1), seconds(2));
  EXPECT_EQ(wide.ack->status.code, "epoch-jump");
  EXPECT_TRUE(wide.ack->refused_epoch);
  EXPECT_EQ(wide.ack->newest_epoch, 1u);
  EXPECT_EQ(wide.notice->code, "command.epoch_jump");
  EXPECT_EQ(ledger.receive(request("b", Action::execute, 1), seconds(3)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(request("c", Action::execute, 1 + kEpochJump), seconds(4)).order,
            Order::carry_out);
  Request lead = request("epoch", Action::execute, 1 + 2 * kEpochJump);
  lead.command = kLeadCommand;
  EXPECT_EQ(ledger.receive(lead, seconds(5)).order, Order::carry_out) << "who is further ahead climbs";
  EXPECT_EQ(ledger.receive(request("d", Action::execute, 2 + 2 * kEpochJump), seconds(6)).order,
            Order::carry_out);
}

TEST(CommandLedger, AnOwnerThatKnowsNobodyTakesNoWideStepEither) {
  CommandLedger ledger;
  EXPECT_EQ(ledger.receive(request("a", Action::execute, 1'000'000), seconds(1)).ack->status.code,
            "epoch-jump");
  EXPECT_EQ(ledger.receive(request("a", Action::execute, kEpochJump), seconds(1)).order, Order::carry_out);
}

// The journal was lost, and the epochs begin anew: the same keys come again and mean something else.
TEST(CommandLedger, AnEpochBelongsToOneProcess) {
  CommandLedger ledger;
  EXPECT_EQ(ledger.receive(of_process(request("a"), 1, 4), seconds(1)).order, Order::carry_out);
  ledger.say(kA, {Stage::completed, "done"}, seconds(2));
  for (const Request& other : {of_process(request("a"), 2, 1), of_process(request("a"), 1, 3)}) {
    const Reception refused = ledger.receive(other, seconds(3));
    EXPECT_EQ(refused.order, Order::nothing);
    EXPECT_EQ(refused.ack->status.code, "doubled-epoch")
        << "never the last status on what another process commanded";
    EXPECT_TRUE(refused.ack->refused_epoch);
    EXPECT_EQ(refused.ack->newest_epoch, 1u);
    EXPECT_EQ(refused.notice->code, "commander.doubled");
  }
  EXPECT_EQ(ledger.receive(of_process(request("b"), 1, 5), seconds(4)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(of_process(request("a", Action::execute, 2), 2, 2), seconds(5)).order,
            Order::nothing)
      << "the old key in a later epoch is asked for again";
  Request next = of_process(request("a", Action::execute, 2), 2, 3);
  next.key.issued_epoch = 2;
  EXPECT_EQ(ledger.receive(next, seconds(6)).order, Order::carry_out);
}

Request stop(const std::string& activity, std::uint64_t epoch, const std::string& sender) {
  Request out = request(activity, Action::execute, epoch, sender);
  out.command = kStopCommand;
  return out;
}

TEST(CommandLedger, AStopIsTakenFromAnybodyOncePerKeyAndRaisesNothing) {
  CommandLedger ledger;
  ledger.receive(request("a", Action::execute, 7, "exec"), seconds(1));
  for (const Request& one :
       {stop("s1", 1, "exec"), stop("s2", 1'000'000, "exec"), stop("s3", 0, "stranger")}) {
    const Reception taken = ledger.receive(one, seconds(2));
    EXPECT_EQ(taken.order, Order::carry_out) << one.key.activity;
    ASSERT_TRUE(taken.notice) << one.key.activity;
    EXPECT_EQ(taken.notice->code, "command.foreign");
    EXPECT_EQ(ledger.receive(one, seconds(3)).order, Order::nothing) << "once per key";
  }
  EXPECT_FALSE(ledger.receive(stop("s4", 7, "exec"), seconds(4)).notice)
      << "who holds the lease is no stranger";
  EXPECT_EQ(ledger.receive(request("b", Action::execute, 7, "exec"), seconds(5)).order, Order::carry_out);
  EXPECT_EQ(ledger.lease_holder("", "drill"), "exec");
}

Request fallback(const std::string& activity, std::uint64_t epoch, const std::string& sender) {
  Request out = request(kFallbackPrefix + activity, Action::execute, epoch, sender);
  out.command = "stow";
  return out;
}

TEST(CommandLedger, AFallbackIsTheLeaseHoldersOrAnybodysWhileThereIsNone) {
  CommandLedger ledger;
  EXPECT_FALSE(ledger.receive(fallback("0", 3, "exec"), seconds(0)).notice);
  ledger.receive(request("a", Action::execute, 7, "exec"), seconds(1));
  EXPECT_EQ(ledger.receive(fallback("1", 7, "exec"), seconds(2)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(fallback("2", 9, "exec"), seconds(2)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(request("b", Action::execute, 7, "exec"), seconds(2)).order, Order::carry_out)
      << "a fall-back raises no epoch";
  const Reception stale = ledger.receive(fallback("3", 6, "exec"), seconds(3));
  EXPECT_TRUE(stale.ack->refused_epoch);
  const Reception foreign = ledger.receive(fallback("4", 8, "stranger"), seconds(3));
  EXPECT_EQ(foreign.ack->status.code, "not-leased");
  EXPECT_EQ(foreign.notice->code, "command.foreign");
  ledger.release("exec");
  const Reception taken = ledger.receive(fallback("5", 1, "exec"), seconds(4));
  EXPECT_EQ(taken.order, Order::carry_out) << "nobody holds the lease, and the robot must come to rest";
  EXPECT_EQ(taken.notice->code, "command.foreign");
  EXPECT_EQ(ledger.lease_holder("", "drill"), "") << "a fall-back takes no lease";
}

TEST(CommandLedger, CommandersAreBounded) {
  CommandLedger ledger;
  for (std::size_t i = 0; i < CommandLedger::kCommanders; ++i)
    ledger.receive(request("a" + std::to_string(i), Action::execute, 1, "c" + std::to_string(i)), seconds(1));
  EXPECT_EQ(ledger.receive(request("b", Action::execute, 1, "more"), seconds(2)).ack->status.code,
            "too-many-commanders");
  EXPECT_EQ(ledger.receive(stop("s", 1, "more"), seconds(2)).order, Order::carry_out);
  EXPECT_EQ(ledger.receive(request("c", Action::execute, 1, "c1"), seconds(2)).order, Order::carry_out);
}

// A stranger with many names does not keep a commander out that comes later.
TEST(CommandLedger, ACommanderWithoutAnOpenCommandOrALeaseGivesItsPlaceToANewOne) {
  const auto begin = [](CommandLedger& ledger, const std::string& name, const std::string& subsystem) {
    Request one = request("a-" + name, Action::execute, 7, name);
    one.subsystem = subsystem;
    return std::pair(ledger.receive(one, seconds(1)), one.key);
  };
  CommandLedger ledger;
  begin(ledger, "open", "drill");
  ledger.say(begin(ledger, "holder", "mast").second, {Stage::completed}, seconds(1));
  for (std::size_t i = 0; i < 3 * CommandLedger::kCommanders; ++i) {
    const auto [taken, key] = begin(ledger, "c" + std::to_string(i), "none" + std::to_string(i));
    ASSERT_EQ(taken.order, Order::carry_out) << i;
    ledger.say(key, {Stage::rejected, "unknown-component"}, seconds(1));
  }
  for (const char* name : {"open", "holder"}) EXPECT_EQ(ledger.newest_epoch(name), 7U) << name;
  EXPECT_EQ(ledger.newest_epoch("c0"), 0U);
  EXPECT_EQ(ledger.lease_holder("", "none9"), "") << "a rejected command takes no lease";

  CommandLedger after;
  for (const LedgerEntry& entry : ledger.kept()) after.restore(entry);
  after.end_restored();
  EXPECT_EQ(begin(after, "dedicated", "drill").first.order, Order::carry_out);
  EXPECT_EQ(after.newest_epoch("c" + std::to_string(3 * CommandLedger::kCommanders - 1)), 7U)
      << "who commanded last stays";
}

TEST(CommandLedger, ARejectedCommandGivesTheLeaseBack) {
  CommandLedger ledger = with_running();
  ledger.receive(request("b", Action::execute, 1, "other"), seconds(2));
  EXPECT_EQ(ledger.lease_holder("", "drill"), "other");
  ledger.say({"b", 1, "other"}, {Stage::rejected, "busy"}, seconds(2));
  EXPECT_EQ(ledger.lease_holder("", "drill"), "");
}

TEST(CommandLedger, WhatWasKeptIsKnownToTheNextProcess) {
  CommandLedger before = with_running();
  Request other = request("b", Action::execute, 5);
  before.receive(other, seconds(2));
  before.say(other.key, {Stage::completed, "done", "", {seconds(3), 4.0, {}}}, seconds(5));
  CommandLedger after;
  for (const LedgerEntry& entry : before.take_entries()) after.restore(entry);
  after.end_restored();
  EXPECT_EQ(after.receive(request("b", Action::execute, 5), seconds(9)).ack->status,
            before.answer(other.key, {}).status);
  const Reception running = after.receive(request("a", Action::query, 5), seconds(9));
  EXPECT_EQ(running.ack->status.code, "owner-restarted");
  EXPECT_EQ(running.ack->status.stage, Stage::failed);
  EXPECT_EQ(after.receive(request("a", Action::execute, 5), seconds(9)).order, Order::nothing) << "done once";
  EXPECT_TRUE(after.receive(request("c", Action::execute, 4), seconds(9)).ack->refused_epoch);
  EXPECT_TRUE(before.take_entries().empty());
}

TEST(CommandLedger, AnOwnerGoesOnWithWhatItHadNotEndedIfItTookNothingElse) {
  CommandLedger before = with_running();
  const std::vector<LedgerEntry> entries = before.take_entries();
  const auto next = [&](const std::vector<LedgerEntry>& more) {
    CommandLedger after;
    for (const LedgerEntry& entry : entries) after.restore(entry);
    for (const LedgerEntry& entry : more) after.restore(entry);
    return after;
  };
  Request running = request("a", Action::execute, 5);
  running.latest_end = seconds(20);
  CommandLedger after = next({});
  EXPECT_TRUE(after.resume(running, seconds(1)));
  after.end_restored();
  EXPECT_EQ(after.receive(request("a", Action::query, 5), seconds(9)).ack->status.stage, Stage::accepted);
  EXPECT_EQ(after.open(running.robot, running.subsystem).size(), 1u) << "a stop finds it";
  EXPECT_TRUE(after.repair(running.key, "again", seconds(19)));
  EXPECT_FALSE(after.repair(running.key, "again", seconds(20))) << "its latest end holds";
  EXPECT_EQ(after.say(running.key, {Stage::completed}, seconds(9))->status.results.duration, seconds(8));

  EXPECT_FALSE(next({}).resume(request("b", Action::execute, 5), seconds(1))) << "it was never taken";
  EXPECT_FALSE(next({{running.key, "", 0, CommandStatus{Stage::completed}}}).resume(running, seconds(1)))
      << "it has ended";
  EXPECT_FALSE(next({{{"s", 1, running.key.commander, 5}, "", 0}}).resume(running, seconds(1)))
      << "that may have been a stop";
}

TEST(CommandLedger, ACancelIsAnOrderFirstAndThenAnOutcome) {
  CommandLedger ledger = with_running();
  const Reception first = ledger.receive(request("a", Action::cancel), seconds(2));
  EXPECT_EQ(first.order, Order::break_off);
  EXPECT_FALSE(first.ack);
  const Reception second = ledger.receive(request("a", Action::cancel), seconds(3));
  EXPECT_EQ(second.order, Order::nothing) << "it is being broken off";
  EXPECT_FALSE(second.ack);
  const Ack ended = *ledger.say(kA, {Stage::cancelled, "cancelled"}, seconds(4));
  EXPECT_EQ(ended.status.results.duration, seconds(3));
  const Ack late = *ledger.receive(request("a", Action::cancel), seconds(5)).ack;
  EXPECT_EQ(late.status.stage, Stage::cancel_failed);
  EXPECT_EQ(late.status.code, "already-ended");
  EXPECT_EQ(ledger.answer(kA, seconds(6)).status.stage, Stage::cancelled)
      << "that is no word on the activity";
}

TEST(CommandLedger, ACancelThatCannotBeLetsTheCommandRun) {
  CommandLedger ledger = with_running();
  EXPECT_FALSE(ledger.refuse_cancel(kA, "nobody asked", seconds(2)));
  ledger.receive(request("a", Action::cancel), seconds(2));
  const Ack refused = *ledger.refuse_cancel(kA, "the drill is too deep", seconds(3));
  EXPECT_EQ(refused.status.stage, Stage::cancel_failed);
  EXPECT_EQ(refused.status.code, "cannot-cancel");
  EXPECT_EQ(ledger.answer(kA, seconds(4)).status.stage, Stage::accepted);
  EXPECT_EQ(ledger.receive(request("a", Action::cancel), seconds(5)).order, Order::break_off) << "once more";
}

TEST(CommandLedger, WhatEndsWhileItIsCancelledHasEndedSo) {
  CommandLedger ledger = with_running();
  ledger.receive(request("a", Action::cancel), seconds(2));
  EXPECT_EQ(ledger.say(kA, {Stage::completed, "done"}, seconds(3))->status.stage, Stage::completed);
  EXPECT_FALSE(ledger.say(kA, {Stage::cancelled, "cancelled"}, seconds(4)));
  EXPECT_EQ(ledger.answer(kA, seconds(5)).status.stage, Stage::completed);
}

TEST(CommandLedger, ResultsStayWithTheLastWord) {
  CommandLedger ledger = with_running();
  const Results results{seconds(2), 30, {{"depth", 0.3}}};
  EXPECT_EQ(ledger.say(kA, {Stage::completed, "done", "", results}, seconds(9))->status.results, results);
  EXPECT_EQ(ledger.answer(kA, seconds(10)).status.results, results);
}

TEST(CommandLedger, WordsOnUnknownCommandsAndAnswersAreNoWords) {
  CommandLedger ledger = with_running();
  EXPECT_FALSE(ledger.say({"b", 1}, {Stage::completed}, seconds(2)));
  EXPECT_FALSE(ledger.say(kA, {Stage::unknown}, seconds(2)));
  EXPECT_FALSE(ledger.say(kA, {Stage::cancel_failed}, seconds(2)));
}

// R146: success looks like success.
TEST(CommandLedger, ARepairInTimeIsInvisibleInTheEnd) {
  CommandLedger ledger = with_running(seconds(100));
  EXPECT_FALSE(ledger.next_overrun());
  const Ack told = *ledger.repair(kA, "it tries again", seconds(40));
  EXPECT_EQ(told.status.stage, Stage::accepted);
  EXPECT_EQ(told.status.code, "repairing");
  EXPECT_EQ(ledger.next_overrun(), seconds(100) + temporal::Time{1});
  EXPECT_THAT(ledger.take_overruns(seconds(100)), testing::IsEmpty()) << "it may end then";
  const Ack done = *ledger.say(kA, {Stage::completed, "done"}, seconds(80));
  EXPECT_EQ(done.status.code, "done");
  EXPECT_EQ(done.status.results.duration, seconds(79)) << "the whole time, the repair with it";
  EXPECT_FALSE(ledger.next_overrun());
  EXPECT_THAT(ledger.take_overruns(seconds(200)), testing::IsEmpty());
}

TEST(CommandLedger, ARepairThatIsNotDoneInTimeIsToldOnce) {
  CommandLedger ledger = with_running(seconds(100));
  ledger.repair(kA, "it tries again", seconds(40));
  EXPECT_THAT(ledger.take_overruns(seconds(100) + temporal::Time{1}), ElementsAre(kA));
  EXPECT_THAT(ledger.take_overruns(seconds(100) + temporal::Time{1}), testing::IsEmpty());
  EXPECT_FALSE(ledger.next_overrun());
}

TEST(CommandLedger, NoRepairAfterTheLatestEndNorOfWhatDoesNotRun) {
  CommandLedger ledger = with_running(seconds(100));
  EXPECT_FALSE(ledger.repair(kA, "too late", seconds(100)));
  EXPECT_FALSE(ledger.repair({"b", 1}, "nothing", seconds(2)));
  ledger.say(kA, {Stage::failed, "jammed"}, seconds(101));
  EXPECT_FALSE(ledger.repair(kA, "over", seconds(50)));
}

TEST(CommandLedger, WithoutALatestEndARepairHasAllTime) {
  CommandLedger ledger = with_running();
  EXPECT_TRUE(ledger.repair(kA, "again", seconds(1e6)));
  EXPECT_FALSE(ledger.next_overrun());
}

TEST(CommandLedger, KnowsWhatASubsystemHasOpen) {
  CommandLedger ledger = with_running();
  Request other = request("b");
  other.subsystem = "arm";
  ledger.receive(other, seconds(2));
  other = request("c");
  other.robot = "scout";
  ledger.receive(other, seconds(2));
  EXPECT_THAT(ledger.open("", "drill"), ElementsAre(kA));
  EXPECT_THAT(ledger.open("scout", "drill"), ElementsAre(CommandKey{"c", 1}));
  ledger.say(kA, {Stage::rejected, "busy"}, seconds(3));
  EXPECT_THAT(ledger.open("", "drill"), testing::IsEmpty());
}

}  // namespace
}  // namespace roci::services::owner
