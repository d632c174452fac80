// A service in a process whose clock is wrong (libfaketime), beside the mission clock in this one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "services/clock/host_anchor.hpp"
#include "services/clock/wall.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/time_watch.hpp"
#include "services/transport/plug_ins.hpp"
#include "tests/contract/support/child_process.hpp"

namespace roci::services::contract {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

#ifdef ROCI_FAKETIME
constexpr char kFaketime[] = ROCI_FAKETIME;
#else
constexpr char kFaketime[] = "";  // it is not installed
#endif

constexpr char kReference[] = "sim_svc";  // of the planetary mission: its clock's master

class HostClocks : public testing::TestWithParam<std::string> {
 protected:
  HostClocks() : folder_(fs::temp_directory_path() / ("roci_host_clocks_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(ROCI_SOURCE_DIR "/missions/planetary", mission(), fs::copy_options::recursive);
    std::ofstream(mission() / "mission.yaml", std::ios::app) << "\nclock: {period_s: 0.05, drift_ppm: 20}\n";
    node::NodeOptions options;
    options.name = kReference;
    options.run = "test";
    options.epoch_unix_us = epoch_;
    options.vendor = GetParam();
    transport::TransportOptions transport;
    transport.domain = domain_.id();
    transport.participant = kReference;
    node_.emplace(options, transport::open_transport(GetParam(), transport));
    watch_.emplace(*node_, TimeWatchSettings{.reference = kReference});
    subscribe(*node_, topics::event, [this](const v1::Event& event) { events_.push_back(event); });
    subscribe(*node_, topics::heartbeat, [this](const v1::Heartbeat& beat) {
      if (beat.service() == "science_svc") state_ = beat.state();
    });
    subscribe(*node_, topics::time_probe,
              [this](const v1::TimeProbe& probe) { answers_ += !probe.answerer().empty(); });
  }
  void SetUp() override {
    if (*kFaketime == '\0')
      GTEST_SKIP() << "there is no libfaketime, by which a clock could be wrong (apt-get install faketime)";
  }
  ~HostClocks() override { fs::remove_all(folder_); }

  fs::path mission() const { return folder_ / "planetary"; }
  fs::path set_by() const { return folder_ / "time"; }

  // A service of the mission on a host whose clock is `wrong` (faketime(1), e.g. "+1" or "+0 x1.0001").
  void start(const std::string& wrong, const std::vector<std::string>& more = {}) {
    set(wrong);
    std::vector<std::string> environment{
        std::string("LD_PRELOAD=") + kFaketime, "FAKETIME_TIMESTAMP_FILE=" + set_by().string(),
        "FAKETIME_NO_CACHE=1", "FAKETIME_DONT_FAKE_MONOTONIC=1", "DONT_FAKE_MONOTONIC=1"};
    environment.insert(environment.end(), more.begin(), more.end());
    service_.emplace(
        std::vector<std::string>{ROCI_BINARY_DIR "/bin/science_svc", "--mission", mission(), "--clock",
                                 "live", "--epoch", std::to_string(epoch_ / 1'000'000), "--run", "test",
                                 "--robot", "rover", "--dds", GetParam(), "--domain",
                                 std::to_string(domain_.id())},
        environment);
  }
  void set(const std::string& wrong) {
    std::ofstream(folder_ / "next") << wrong << "\n";
    fs::rename(folder_ / "next", set_by());
  }

  // Turns this node's loop until it is so, for at most two minutes.
  bool until(const std::function<bool()>& so) {
    const auto end = clock::wall_now() + clock::wall_seconds(120);
    while (!so() && clock::wall_now() < end) node_->spin_once(std::chrono::milliseconds(20));
    return so();
  }
  const v1::Event* newest(const std::string& code) const {
    for (auto event = events_.rbegin(); event != events_.rend(); ++event)
      if (event->code() == code) return &*event;
    return nullptr;
  }
  static std::string property(const v1::Event& event, const std::string& name) {
    for (const v1::Property& property : event.properties())
      if (property.name() == name) return property.value();
    return "none";
  }

  process::DomainClaim domain_;
  fs::path folder_;
  std::int64_t epoch_ = clock::unix_us() / 1'000'000 * 1'000'000;
  std::optional<Node> node_;
  std::optional<TimeWatch> watch_;
  std::optional<ChildProcess> service_;
  std::vector<v1::Event> events_;
  int answers_ = 0;  // of this node to the service
  v1::ServiceState state_ = v1::SERVICE_STARTING;
};

TEST_P(HostClocks, ASecondTooFastIsToldAndDegradesUntilItIsSetRight) {
  start("+1");
  ASSERT_TRUE(until([this] { return newest("clock.offset") != nullptr; }));
  const v1::Event& beyond = *newest("clock.offset");
  EXPECT_THAT(beyond.text(), StartsWith("science_svc: the clock is "));
  EXPECT_THAT(beyond.text(), ContainsRegex(" (0[.]9|1[.]0).* s ahead"));  // give or take what an answer took
  EXPECT_THAT(beyond.text(), HasSubstr("beyond the bound of 0.250 s"));
  EXPECT_EQ(beyond.severity_level(), v1::SEVERITY_WARNING);
  EXPECT_NEAR(std::stod(property(beyond, "offset_s")), 1, 0.2);
  EXPECT_EQ(property(beyond, "reference"), kReference);
  EXPECT_TRUE(until([this] { return state_ == v1::SERVICE_DEGRADED; }));
  set("+0");
  ASSERT_TRUE(until([this] { return property(*newest("clock.offset"), "beyond") == "false"; }));
  EXPECT_TRUE(until([this] { return state_ == v1::SERVICE_RUNNING; }));
}

TEST_P(HostClocks, ASecondAndAnHourTooSlowOrTooFastAreTold) {
  for (const auto& [wrong, offset_s] :
       std::map<std::string, double>{{"-1", -1}, {"+1h", 3600}, {"-1h", -3600}}) {
    SCOPED_TRACE(wrong);
    events_.clear();
    start(wrong);
    ASSERT_TRUE(until([this] { return newest("clock.offset") != nullptr; }));
    EXPECT_NEAR(std::stod(property(*newest("clock.offset"), "offset_s")), offset_s, 0.2);
    service_.reset();
  }
}

TEST_P(HostClocks, ADriftOf100PpmIsTold) {
  start("+0 x1.0001");
  ASSERT_TRUE(until([this] { return newest("clock.drift") != nullptr; }));
  EXPECT_NEAR(std::stod(property(*newest("clock.drift"), "drift_ppm")), 100, 80);
  EXPECT_EQ(newest("clock.offset"), nullptr);
  EXPECT_TRUE(until([this] { return state_ == v1::SERVICE_DEGRADED; }));
}

TEST_P(HostClocks, AClockThatIsRightIsNotSpokenOf) {
  start("+0");
  ASSERT_TRUE(until([this] { return state_ == v1::SERVICE_RUNNING; }));
  ASSERT_TRUE(until([this] { return answers_ >= 40; }));
  EXPECT_EQ(newest("clock.offset"), nullptr);
  EXPECT_EQ(newest("clock.drift"), nullptr);
  EXPECT_EQ(state_, v1::SERVICE_RUNNING);
}

// Whoever started it has handed it the anchor of the host (clock/host_anchor.hpp).
TEST_P(HostClocks, AnAnchoredServiceKeepsTheMissionClockWhenTheSystemClockIsSet) {
  start("+0", {std::string(clock::kHostAnchorVariable) + "=" + to_text(clock::anchor_host())});
  ASSERT_TRUE(until([this] { return state_ == v1::SERVICE_RUNNING && answers_ >= 10; }));
  for (const char* wrong : {"-1h", "+300"}) {
    SCOPED_TRACE(wrong);
    set(wrong);
    const int answered = answers_;
    EXPECT_TRUE(until([&] { return answers_ >= answered + 30; })) << "it stands still";
    EXPECT_EQ(newest("clock.offset"), nullptr);
    EXPECT_EQ(state_, v1::SERVICE_RUNNING);
  }
}

// As under systemd: each service is started by itself, and one of the host watches the clock for all, until it dies.
TEST_P(HostClocks, WhereNoLauncherStaysOneServiceTellsThatTheSystemClockWasSet) {
  set("+0");
  const auto become = [this](const std::string& service) {
    return std::make_unique<ChildProcess>(
        std::vector<std::string>{ROCI_BINARY_DIR "/bin/roci-launch", mission(), "--become", service,
                                 "--clock", "live", "--epoch", std::to_string(epoch_ / 1'000'000), "--run",
                                 "test", "--dds", GetParam(), "--domain", std::to_string(domain_.id()),
                                 "--run-folder", folder_ / "run"},
        std::vector<std::string>{std::string("LD_PRELOAD=") + kFaketime,
                                 "FAKETIME_TIMESTAMP_FILE=" + set_by().string(), "FAKETIME_NO_CACHE=1",
                                 "FAKETIME_DONT_FAKE_MONOTONIC=1", "DONT_FAKE_MONOTONIC=1"});
  };
  std::map<std::string, std::unique_ptr<ChildProcess>> services;
  for (const char* name : {"science_svc", "arm_svc"}) services[name] = become(name);
  const auto there = [this] { return node_->peer_alive("science_svc") && node_->peer_alive("arm_svc"); };
  ASSERT_TRUE(until(there));
  const auto told = [this] {
    return std::ranges::count_if(events_, [](const v1::Event& event) { return event.code() == "clock.set"; });
  };
  set("-1h");
  ASSERT_TRUE(until([&] { return told() > 0; }));
  EXPECT_THAT(newest("clock.set")->text(), HasSubstr("was set back by 36"));
  const std::string teller = newest("clock.set")->header().sender();
  // Whoever looks once a second would have told by then.
  const int answered = answers_;
  ASSERT_TRUE(until([&] { return answers_ >= answered + 60; }));
  EXPECT_EQ(told(), 1) << "one for all";
  services.at(teller)->kill();
  set("+300");
  ASSERT_TRUE(until([&] { return told() > 1; }));
  EXPECT_NE(newest("clock.set")->header().sender(), teller);
}

INSTANTIATE_TEST_SUITE_P(Vendors, HostClocks, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace roci::services::contract
