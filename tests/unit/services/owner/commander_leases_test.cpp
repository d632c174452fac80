// Who commands in a name, as an owner decides.
#include "services/owner/commander_leases.hpp"

#include <gtest/gtest.h>

namespace roci::services::owner {
namespace {

using namespace std::chrono_literals;

LeaseAsk ask(const std::string& member, std::uint64_t epoch, std::chrono::microseconds said,
             bool wanted = true) {
  return {"exec_svc", member, epoch, wanted, false, 2s, said};
}

TEST(CommanderLeases, AreGrantedToOneAtATime) {
  CommanderLeases leases;
  EXPECT_EQ(leases.ask(ask("first", 1, 10s), 0, 100s), (LeaseGrant{"first", 1, 2s, 10s}));
  EXPECT_EQ(leases.ask(ask("second", 2, 7s), 0, 101s).member, "first") << "a later epoch changes nothing";
  EXPECT_TRUE(leases.admits("exec_svc", 1, 101s));
  EXPECT_FALSE(leases.admits("exec_svc", 2, 101s));
  EXPECT_TRUE(leases.admits("exec_svc.south", 2, 101s)) << "another commander has its own";
}

TEST(CommanderLeases, LastForTheirTermAfterTheNewestRenewalOrCommand) {
  CommanderLeases leases;
  leases.ask(ask("first", 1, 10s), 0, 100s);
  leases.ask(ask("first", 1, 11s), 0, 101s);
  EXPECT_EQ(leases.ask(ask("second", 2, 7s), 0, 102900ms).member, "first");
  EXPECT_TRUE(leases.admits("exec_svc", 1, 102900ms));
  EXPECT_EQ(leases.ask(ask("second", 2, 8s), 0, 104s).member, "first");
  EXPECT_EQ(leases.ask(ask("second", 2, 9s), 0, 105s).member, "second");
  EXPECT_EQ(leases.ask(ask("first", 1, 15s), 0, 105s).member, "second");
  EXPECT_FALSE(leases.admits("exec_svc", 1, 105s));
}

TEST(CommanderLeases, AreGivenBackByTheirHolderAlone) {
  CommanderLeases leases;
  leases.ask(ask("first", 1, 10s), 0, 100s);
  leases.ask(ask("second", 2, 7s, false), 0, 100s);
  EXPECT_EQ(leases.grant("exec_svc", 100s).member, "first");
  leases.ask(ask("first", 1, 9s, false), 0, 100s);
  EXPECT_EQ(leases.grant("exec_svc", 100s).member, "first") << "said before it asked, and came late";
  leases.ask(ask("first", 1, 11s, false), 0, 100s);
  EXPECT_EQ(leases.grant("exec_svc", 100s).member, "");
  EXPECT_EQ(leases.ask(ask("second", 2, 8s), 0, 100s).member, "second");
}

TEST(CommanderLeases, AreNotForWhoseEpochIsOver) {
  CommanderLeases leases;
  EXPECT_EQ(leases.ask(ask("first", 1, 10s), 2, 100s).member, "");
  EXPECT_EQ(leases.ask(ask("first", 3, 10s), 2, 100s).member, "first");
}

TEST(CommanderLeases, AreNotForWhoWasReplacedByOneThatLed) {
  CommanderLeases leases;
  LeaseAsk leader = ask("second", 2, 10s);
  leases.ask(leader, 0, 100s);
  EXPECT_EQ(leases.ask(ask("first", 1, 10s), 0, 110s).member, "first") << "it would have led, and never did";
  leader.leads = true;
  leases.ask(leader, 0, 120s);
  EXPECT_EQ(leases.newest_led("exec_svc"), 2U);
  EXPECT_EQ(leases.ask(ask("first", 1, 10s), 0, 130s).member, "");
  EXPECT_EQ(leases.ask(ask("first", 3, 10s), 0, 130s).member, "first");
}

// One forged request must not keep the pair from its robot for good.
TEST(CommanderLeases, AreNotForAnEpochFarAhead) {
  CommanderLeases leases;
  LeaseAsk forged = ask("first", 1000000, 10s);
  forged.leads = true;
  EXPECT_EQ(leases.ask(forged, 0, 100s).member, "");
  EXPECT_EQ(leases.newest_led("exec_svc"), 0U);
  leases.ask(ask("first", 1, 10s), 0, 100s);
  EXPECT_EQ(leases.ask(forged, 0, 101s), (LeaseGrant{"first", 1, 2s, 10s}))
      << "nor in the name of the holder";
  EXPECT_EQ(leases.ask(ask("first", 1000, 11s), 0, 101s).epoch, 1000U);
}

TEST(CommanderLeases, HaveABoundOnTermsAndOnCommanders) {
  CommanderLeases leases;
  LeaseAsk greedy = ask("first", 1, 10s);
  greedy.term = 1000000s;
  EXPECT_EQ(leases.ask(greedy, 0, 100s).term, CommanderLeases::kLongestTerm);
  for (int i = 0; i < 1000; ++i) {
    greedy.commander = std::to_string(i);
    leases.ask(greedy, 0, 100s);
  }
  EXPECT_EQ(leases.grant("999", 100s).member, "");
  EXPECT_EQ(leases.ask(greedy, 0, 200s).member, "first") << "those of before have run out";
}

// Where whoever leads first asks after a flood, it is nobody's commander otherwise.
TEST(CommanderLeases, AreForOneThatNobodyKnowsWhenInventedLeadersHaveRunOut) {
  CommanderLeases leases;
  LeaseAsk invented = ask("forger", 1, 10s);
  invented.leads = true;
  for (int i = 0; i < 1000; ++i) {
    invented.commander = std::to_string(i);
    leases.ask(invented, 0, 100s);
  }
  EXPECT_EQ(leases.ask(ask("first", 1, 10s), 0, 101s).member, "") << "all of them hold leases";
  EXPECT_EQ(leases.ask(ask("first", 1, 11s), 0, 103s).member, "first");
}

TEST(CommanderLeases, OfOneThatHoldsStillRememberThatItLed) {
  CommanderLeases leases;
  LeaseAsk leader = ask("second", 2, 10s);
  leader.leads = true;
  leader.term = 60s;
  leases.ask(leader, 0, 100s);
  LeaseAsk invented = ask("forger", 1, 10s);
  invented.leads = true;
  for (int i = 0; i < 1000; ++i) {
    invented.commander = std::to_string(i);
    leases.ask(invented, 0, 100s + i * 50ms);
  }
  EXPECT_EQ(leases.newest_led("exec_svc"), 2U);
  EXPECT_EQ(leases.newest_led("999"), 1U) << "and those of before, whose leases are over, were forgotten";
  EXPECT_EQ(leases.newest_led("0"), 0U);
}

}  // namespace
}  // namespace roci::services::owner
