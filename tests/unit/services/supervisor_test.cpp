// When roci-launch starts a service again, and how a run ends.
#include "services/launch/supervisor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <map>
#include <system_error>

#include "services/launch/child.hpp"
#include "services/launch/restart_policy.hpp"

namespace roci::services::launch {
namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

TEST(RestartPolicy, WaitsLongerEachTimeAndGivesUp) {
  RestartPolicy policy;
  EXPECT_EQ(*policy.died(0s), 200ms);
  EXPECT_EQ(*policy.died(1s), 400ms);
  EXPECT_EQ(*policy.died(1s), 800ms);
  EXPECT_EQ(*policy.died(1s), 1600ms);
  EXPECT_FALSE(policy.died(1s));
}

TEST(RestartPolicy, ALongLifeStartsANewRow) {
  RestartPolicy policy;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(*policy.died(i % 2 == 0 ? 60s : 1s), i % 2 == 0 ? 200ms : 400ms);
}

// Services are shell commands here; time is what the test says.
class SupervisorTest : public testing::Test {
 protected:
  SupervisorTest() { fs::create_directories(folder); }
  ~SupervisorTest() override { fs::remove_all(folder); }

  Supervisor make(std::vector<std::string> names, bool master_is_clock = true,
                  const std::function<void(Supervisor::Hooks&)>& add = nullptr,
                  std::uint32_t incarnations = 0) {
    Supervisor::Hooks hooks;
    if (add) add(hooks);
    hooks.start = [this](const std::string& service, std::uint32_t incarnation) {
      starts.push_back(service + "#" + std::to_string(incarnation));
      if (no_room) throw std::system_error(EAGAIN, std::generic_category(), "cannot start " + service);
      auto child = std::make_unique<Child>("/bin/sh", std::vector<std::string>{"sh", "-c", script[service]},
                                           folder / "log");
      pids[service] = child->pid();
      return child;
    };
    hooks.on_death = [this](const std::string& service, const std::string& what) {
      deaths.push_back(service + " " + what);
    };
    return {names, "sim_svc", master_is_clock, Watchdog(10), std::move(hooks), incarnations};
  }
  static void turn_until(Supervisor& supervisor, clock::WallTime now, const std::function<bool()>& done) {
    while (!done()) supervisor.turn(now);
  }

  fs::path folder =
      fs::temp_directory_path() / ("roci-supervisor-" + std::to_string(getpid()) +
                                   testing::UnitTest::GetInstance()->current_test_info()->name());
  clock::WallTime start{1000s};
  std::map<std::string, std::string> script;
  std::vector<std::string> starts;
  std::vector<std::string> deaths;
  std::map<std::string, pid_t> pids;
  bool no_room = false;  // for another process
};

TEST_F(SupervisorTest, ACleanEndOfAllIsTheEnd) {
  script = {{"sim_svc", "exit 0"}, {"arm_svc", "exit 0"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return supervisor.finished(); });
  EXPECT_FALSE(supervisor.failure());
  EXPECT_THAT(starts, ElementsAre("arm_svc#1", "sim_svc#1"));
}

TEST_F(SupervisorTest, ARestartForWhichThereIsNoRoomIsTriedAgainLater) {
  script = {{"arm_svc", "kill -9 $$"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return deaths.size() == 1; });
  no_room = true;
  supervisor.turn(start + 1s);
  ASSERT_EQ(deaths.size(), 2U);
  EXPECT_THAT(deaths[1], HasSubstr("arm_svc cannot start arm_svc: Resource temporarily unavailable; starting it again"));
  no_room = false;
  script["arm_svc"] = "exec tail -f /dev/null";
  supervisor.turn(start + 1s + RestartPolicy::kHelperPause);
  EXPECT_THAT(starts, ElementsAre("arm_svc#1", "sim_svc#1", "arm_svc#2", "arm_svc#2"));
  EXPECT_FALSE(supervisor.failure());
  EXPECT_FALSE(supervisor.finished());
}

TEST_F(SupervisorTest, ADeadServiceIsStartedAgainAsTheNextIncarnation) {
  script = {{"arm_svc", "kill -9 $$"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return deaths.size() == 1; });
  EXPECT_THAT(deaths[0], HasSubstr("arm_svc was ended by Killed; starting it again"));
  supervisor.turn(start + 199ms);
  EXPECT_EQ(starts.size(), 2U);
  script["arm_svc"] = "exec tail -f /dev/null";
  supervisor.turn(start + 200ms);
  EXPECT_THAT(starts, ElementsAre("arm_svc#1", "sim_svc#1", "arm_svc#2"));
  EXPECT_FALSE(supervisor.finished());
}

TEST_F(SupervisorTest, FiveDeathsInARowEndTheRun) {
  script = {{"arm_svc", "exit 1"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  auto now = start;
  for (std::size_t death = 1; death <= 5; ++death, now += 10s) {
    turn_until(supervisor, now, [&] { return deaths.size() == death; });
  }
  turn_until(supervisor, now, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_EQ(supervisor.failure()->service, "arm_svc");
  EXPECT_THAT(supervisor.failure()->reason, HasSubstr("ended with code 1, the 5th time in a row"));
}

TEST_F(SupervisorTest, AHelperThatCannotBeKeptIsMissedAndTriedOn) {
  script = {{"science_svc", "exit 1"}, {"sim_svc", "exec tail -f /dev/null"}};
  std::vector<std::string> missed;
  auto supervisor = make({"science_svc", "sim_svc"}, true, [&](Supervisor::Hooks& hooks) {
    hooks.may_be_missed = [](const std::string& service) { return service == "science_svc"; };
    hooks.on_missed = [&](const std::string& service, const std::string& what) {
      missed.push_back(service + " " + what);
    };
  });
  supervisor.start(start);
  auto now = start;
  for (std::size_t death = 1; death <= 12; ++death, now += 30s)
    turn_until(supervisor, now, [&] { return deaths.size() == death; });
  EXPECT_FALSE(supervisor.failure());
  EXPECT_FALSE(supervisor.finished());
  EXPECT_THAT(
      missed,
      ElementsAre("science_svc ended with code 1, the 5th time in a row; the mission goes on without it"));
  EXPECT_EQ(starts.size(), 1U + 12U);
  supervisor.turn(now - 1s);
  EXPECT_EQ(starts.size(), 1U + 12U) << "30 s between two starts";
}

// Its vendor is not installed on this host.
TEST_F(SupervisorTest, AHelperWithoutATransportIsMissedAndTriedOn) {
  script = {{"science_svc", "exit 3"}, {"sim_svc", "exec tail -f /dev/null"}};
  std::vector<std::string> missed;
  auto supervisor = make({"science_svc", "sim_svc"}, true, [&](Supervisor::Hooks& hooks) {
    hooks.may_be_missed = [](const std::string& service) { return service == "science_svc"; };
    hooks.on_missed = [&](const std::string& service, const std::string& what) {
      missed.push_back(service + " " + what);
    };
  });
  supervisor.start(start);
  auto now = start;
  for (std::size_t death = 1; death <= 3; ++death, now += 31s)
    turn_until(supervisor, now, [&] { return deaths.size() == death; });
  EXPECT_FALSE(supervisor.failure());
  EXPECT_THAT(missed, ElementsAre("science_svc ended with code 3; the mission goes on without it"));
}

TEST_F(SupervisorTest, BadInputIsNotTriedAgain) {
  script = {{"arm_svc", "exit 2"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_TRUE(supervisor.failure()->bad_input);
  EXPECT_EQ(starts.size(), 2U);
}

// Its next incarnation is the later one of the two, and goes on; whoever outdoes each of them ends the run.
TEST_F(SupervisorTest, AServiceThatYieldsToANamesakeIsStartedAgainAsALaterIncarnation) {
  script = {{"arm_svc", "exit 5"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"}, false);
  supervisor.start(start);
  auto now = start;
  for (std::size_t death = 1; death <= 5; ++death, now += 10s) {
    EXPECT_FALSE(supervisor.failure());
    turn_until(supervisor, now, [&] { return deaths.size() == death; });
  }
  EXPECT_EQ(deaths[0],
            "arm_svc ended with code 5 (another process of the run has its name); starting it again");
  EXPECT_THAT(starts, Contains("arm_svc#5"));
  turn_until(supervisor, now, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_FALSE(supervisor.failure()->bad_input);
}

TEST_F(SupervisorTest, AHungServiceIsKilledAndStartedAgain) {
  script = {{"arm_svc", "exec tail -f /dev/null"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"}, false);
  supervisor.start(start);
  auto now = start;
  for (; now < start + 59s; now += 1s) supervisor.turn(now);
  EXPECT_THAT(deaths, ElementsAre());
  turn_until(supervisor, start + 61s, [&] { return deaths.size() == 2; });
  EXPECT_THAT(deaths, Contains("arm_svc was ended by Killed (hung: its loop has not turned for 60 s); "
                               "starting it again"));
  supervisor.turn(start + 62s);
  EXPECT_THAT(starts, testing::UnorderedElementsAre("arm_svc#1", "sim_svc#1", "arm_svc#2", "sim_svc#2"));
  EXPECT_FALSE(supervisor.failure());
}

TEST_F(SupervisorTest, AHungClockEndsTheRun) {
  script = {{"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"sim_svc"});
  supervisor.start(start);
  auto now = start;
  for (; now < start + 59s; now += 1s) supervisor.turn(now);
  turn_until(supervisor, start + 61s, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_THAT(supervisor.failure()->reason, HasSubstr("hung: its loop has not turned"));
}

TEST_F(SupervisorTest, ATransportThatIsMissingFromTheStartEndsTheRun) {
  script = {{"arm_svc", "exit 3"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_EQ(starts.size(), 2U);
}

// Its loop has turned once; after that there is no network for it, for longer than five deaths in a row.
TEST_F(SupervisorTest, AServiceWaitsAsLongAsItsNetworkIsOut) {
  script = {{"arm_svc", "exit 3"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  supervisor.watchdog().kick(pids["arm_svc"], start);
  auto now = start;
  for (std::size_t death = 1; death <= 40; ++death, now += 2s) {
    supervisor.watchdog().kick(pids["sim_svc"], now);
    turn_until(supervisor, now, [&] { return deaths.size() == death; });
  }
  EXPECT_THAT(deaths.back(), HasSubstr("as long as its network is out; starting it again"));
  EXPECT_FALSE(supervisor.failure());
  EXPECT_EQ(starts.size(), 41U);
}

// The network is out when another launcher goes on with a run.
TEST_F(SupervisorTest, AServiceOfAContinuedRunWaitsForItsNetworkFromTheStart) {
  script = {{"arm_svc", "exit 3"}, {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"}, false, nullptr, 10'000);
  supervisor.start(start);
  auto now = start;
  for (std::size_t death = 1; death <= 3; ++death, now += 2s)
    turn_until(supervisor, now, [&] { return deaths.size() == death || supervisor.failure(); });
  EXPECT_FALSE(supervisor.failure());
  EXPECT_THAT(starts, Contains("arm_svc#10003"));
}

TEST_F(SupervisorTest, TheRunEndsWithItsClock) {
  script = {{"arm_svc", "exec tail -f /dev/null"}, {"sim_svc", "exit 1"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return supervisor.finished(); });
  ASSERT_TRUE(supervisor.failure());
  EXPECT_THAT(supervisor.failure()->reason, HasSubstr("it is the clock of the run"));
}

TEST_F(SupervisorTest, LiveServicesAreAskedToLeaveWhenTheRobotIsDone) {
  script = {{"arm_svc", "trap 'exit 0' TERM; while :; do :; done"}, {"sim_svc", "exit 0"}};
  auto supervisor = make({"arm_svc", "sim_svc"}, false);
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return supervisor.finished(); });
  EXPECT_FALSE(supervisor.failure());
}

TEST_F(SupervisorTest, WhoDoesNotLeaveIsKilledInTheEnd) {
  const fs::path ready = folder / "ready";
  script = {{"arm_svc", "trap '' TERM; touch " + ready.string() + "; while :; do :; done"},
            {"sim_svc", "exec tail -f /dev/null"}};
  auto supervisor = make({"arm_svc", "sim_svc"});
  supervisor.start(start);
  turn_until(supervisor, start, [&] { return fs::exists(ready); });
  supervisor.stop(start);       // the clock ends at once, the arm does not listen
  supervisor.turn(start + 5s);  // SIGTERM for all
  EXPECT_FALSE(supervisor.finished());
  turn_until(supervisor, start + 10s, [&] { return supervisor.finished(); });  // SIGKILL
  EXPECT_FALSE(supervisor.failure());
}

}  // namespace
}  // namespace roci::services::launch
