// A real service whose DDS locks up: while it lives, and while it ends.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include "services/clock/wall.hpp"
#include "services/launch/notify_socket.hpp"
#include "services/launch/supervisor.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class LockedTransport : public testing::Test {
 protected:
  LockedTransport() { fs::create_directories(folder_); }
  ~LockedTransport() override { fs::remove_all(folder_); }

  std::unique_ptr<services::launch::Child> start(const std::string& where) {
    return std::make_unique<services::launch::Child>(
        ROCI_BINARY_DIR "/bin/arm_svc",
        std::vector<std::string>{"arm_svc", "--mission", ROCI_SOURCE_DIR "/missions/planetary", "--clock",
                                 "live", "--dds", "locked", "--run-folder", folder_.string()},
        log_,
        std::vector<std::string>{"NOTIFY_SOCKET=" + signs_.address(), "ROCI_LOCKED=" + where,
                                 "ROCI_PLUGIN_PATH=" ROCI_BINARY_DIR "/tests/locked_transport"});
  }
  // Turns of a launcher; false: not done within a minute.
  static bool turn_until(const std::function<bool()>& done) {
    for (const auto limit = services::clock::wall_now() + services::clock::wall_seconds(60);
         services::clock::wall_now() < limit; poll(nullptr, 0, 20)) {
      if (done()) return true;
    }
    return false;
  }
  std::string log() const {
    std::ostringstream text;
    text << std::ifstream(log_).rdbuf();
    return text.str();
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_locked_" + std::to_string(::getpid()));
  const fs::path log_ = folder_ / "log";
  services::launch::NotifySocket signs_;
};

TEST_F(LockedTransport, EndsAllTheSameAndWithItsCode) {
  const auto child = start("end");
  ASSERT_TRUE(turn_until([&] { return !signs_.receive().empty(); })) << log();
  child->signal(SIGTERM);
  ASSERT_TRUE(turn_until([&] { return child->ending().has_value(); }));
  EXPECT_TRUE(child->ending()->exited);
  EXPECT_EQ(child->ending()->code, services::launch::kServiceStopped);
  EXPECT_THAT(log(), HasSubstr("arm_svc: its work is done; it did not end by itself, so it was ended"));
}

TEST_F(LockedTransport, IsReplacedWhenItsLoopStandsStill) {
  std::vector<std::string> deaths;
  std::vector<std::string> places{"nowhere", "write"};
  services::launch::Supervisor::Hooks hooks;
  hooks.start = [&](const std::string&, std::uint32_t) {
    auto child = start(places.back());
    places.pop_back();
    return child;
  };
  hooks.on_death = [&](const std::string& service, const std::string& what) {
    deaths.push_back(service + " " + what);
  };
  services::launch::Supervisor supervisor({"arm_svc"}, "sim_svc", false, services::launch::Watchdog(2),
                                          std::move(hooks));
  supervisor.start(services::clock::wall_now());
  std::size_t signs_of_the_second = 0;
  EXPECT_TRUE(turn_until([&] {
    const auto senders = signs_.receive();
    for (const pid_t sender : senders) supervisor.watchdog().kick(sender, services::clock::wall_now());
    supervisor.turn(services::clock::wall_now());
    if (!deaths.empty()) signs_of_the_second += senders.size();
    return signs_of_the_second > 12;  // longer than the first one lived
  })) << log();
  EXPECT_THAT(deaths,
              ElementsAre("arm_svc was ended by Killed (hung: its loop has not turned for 2 s); starting "
                          "it again"));
}

}  // namespace
}  // namespace roci::scenario
