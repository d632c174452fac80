// Who counts as hung, and how a process says that it is not.
#include "services/launch/watchdog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "services/health/watchdog_notifier.hpp"
#include "services/launch/notify_socket.hpp"
#include "services/process/forced_exit.hpp"

namespace roci::services::launch {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class WatchdogTest : public testing::Test {
 protected:
  WatchdogTest() {
    watchdog.started("arm_svc", 1, 11, start);
    watchdog.started("sim_svc", 1, 12, start);
    watchdog.heard({"arm_svc", 1, true, ""}, start);
    watchdog.heard({"sim_svc", 1, true, ""}, start);
  }
  // Turns of the launcher until `end`, with a sign of life of `who` in each.
  std::vector<std::string> hung_until(clock::WallTime end, std::vector<pid_t> who) {
    std::vector<std::string> hung;
    for (; now <= end; now += 100ms) {
      for (const pid_t pid : who) watchdog.kick(pid, now);
      for (const auto& one : watchdog.check(now)) hung.push_back(one.service + " " + one.reason);
    }
    return hung;
  }

  const clock::WallTime start{1000s};
  clock::WallTime now = start;
  Watchdog watchdog{10};
};

TEST_F(WatchdogTest, WhoseLoopTurnsIsNotHung) { EXPECT_THAT(hung_until(start + 1h, {11, 12}), IsEmpty()); }

TEST_F(WatchdogTest, WhoseLoopStandsStillIsNamedOnce) {
  EXPECT_THAT(hung_until(start + 5s, {11, 12}), IsEmpty());
  EXPECT_THAT(hung_until(start + 15s, {12}), IsEmpty());
  const auto hung = hung_until(start + 60s, {12});
  ASSERT_EQ(hung.size(), 1U);
  EXPECT_EQ(hung[0], "arm_svc hung: its loop has not turned for 10 s");
}

TEST_F(WatchdogTest, ReadingFilesBeforeTheFirstTurnMayTakeLonger) {
  EXPECT_THAT(hung_until(start + 60s, {12}), IsEmpty());
  EXPECT_EQ(hung_until(start + 61s, {12}).size(), 1U);
}

TEST_F(WatchdogTest, WhoIsHeardByNobodyIsHungThoughItsLoopTurns) {
  hung_until(start + 5s, {11, 12});
  watchdog.heard({"arm_svc", 1, false, "killed"}, now);
  EXPECT_THAT(hung_until(start + 15s, {11, 12}), IsEmpty());
  const auto hung = hung_until(start + 60s, {11, 12});
  ASSERT_EQ(hung.size(), 1U);
  EXPECT_THAT(hung[0], HasSubstr("arm_svc hung: its loop turns, but nobody has heard it for 10 s"));
}

TEST_F(WatchdogTest, WhoIsHeardAgainInTimeIsNotHung) {
  watchdog.heard({"arm_svc", 1, false, "hung"}, now);
  hung_until(start + 9s, {11, 12});
  watchdog.heard({"arm_svc", 1, true, ""}, now);
  EXPECT_THAT(hung_until(start + 60s, {11, 12}), IsEmpty());
}

TEST_F(WatchdogTest, WhoLeftOrWasReplacedIsNotHung) {
  watchdog.heard({"arm_svc", 1, false, "left"}, now);
  watchdog.started("sim_svc", 2, 13, now);
  watchdog.heard({"sim_svc", 1, false, "killed"}, now);
  watchdog.heard({"exec_svc", 1, true, ""}, now);
  EXPECT_THAT(hung_until(start + 60s, {11, 13}), IsEmpty());
}

TEST_F(WatchdogTest, ALauncherThatHearsNobodyBlamesNobody) {
  watchdog.heard({"arm_svc", 1, false, "killed"}, now);
  watchdog.heard({"sim_svc", 1, false, "killed"}, now);
  EXPECT_THAT(hung_until(start + 60s, {11, 12}), IsEmpty());
}

TEST_F(WatchdogTest, ALauncherThatStoodStillBeginsToCountAnew) {
  hung_until(start + 5s, {11, 12});
  now += 1h;  // stopped with Ctrl-Z; the signs of the meantime did not fit into the socket
  EXPECT_THAT(watchdog.check(now), IsEmpty());
  EXPECT_THAT(hung_until(now + 9s, {}), IsEmpty());
  EXPECT_EQ(hung_until(now + 2s, {}).size(), 2U);
}

TEST_F(WatchdogTest, NoLimitNoHang) {
  watchdog = Watchdog(0);
  watchdog.started("arm_svc", 1, 11, start);
  EXPECT_THAT(hung_until(start + 1h, {}), IsEmpty());
}

TEST(WatchdogNotifier, ReachesTheSupervisorWithItsSender) {
  NotifySocket signs;
  health::WatchdogNotifier sign(signs.address());
  EXPECT_THAT(signs.receive(), IsEmpty());
  sign.notify();
  sign.notify();  // too soon
  EXPECT_THAT(signs.receive(), testing::ElementsAre(getpid()));
}

TEST(WatchdogNotifier, NobodyNeedsToListen) {
  health::WatchdogNotifier("").notify();
  std::string address;
  {
    const NotifySocket gone;
    address = gone.address();
  }
  EXPECT_THROW(health::WatchdogNotifier{address}, std::system_error);
  EXPECT_THROW(health::WatchdogNotifier{"nonsense"}, std::invalid_argument);
  EXPECT_THROW(health::WatchdogNotifier{"/" + std::string(200, 'x')}, std::invalid_argument);
}

TEST(WatchdogNotifier, ASupervisorThatDoesNotReadNeverBlocksAService) {
  const NotifySocket signs;
  std::vector<std::unique_ptr<health::WatchdogNotifier>> senders;
  for (int i = 0; i < 1000; ++i) {
    senders.push_back(std::make_unique<health::WatchdogNotifier>(signs.address()));
    senders.back()->notify();
  }
}

TEST(EndWithin, EndsAProcessThatHangs) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto hang = [] {
    process::force_exit_after(50ms, 7, "arm_svc: its work is done");
    for (;;) pause();
  };
  EXPECT_EXIT(hang(), testing::ExitedWithCode(7),
              "arm_svc: its work is done; it did not end by itself, so it was ended");
}

TEST(EndWithin, LeavesOthersAlone) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto leave = [] {
    process::force_exit_after(1h, 7, "never said");
    std::exit(3);
  };
  EXPECT_EXIT(leave(), testing::ExitedWithCode(3), Not(HasSubstr("never said")));
}

}  // namespace
}  // namespace roci::services::launch
