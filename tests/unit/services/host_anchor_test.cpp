// The clock that nobody sets, as the services of a host share it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

#include "services/clock/live_clock.hpp"
#include "services/launch/anchor_file.hpp"

namespace roci::services::clock {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kHourUs = 3'600'000'000;

TEST(HostAnchor, ComesBackAsItWasHanded) {
  const HostAnchor anchor = anchor_host();
  EXPECT_FALSE(anchor.boot.empty());
  EXPECT_EQ(anchor_of(to_text(anchor)), anchor);
}

TEST(HostAnchor, OfAnotherStartOfTheHostIsNone) {
  HostAnchor anchor = anchor_host();
  anchor.boot = "0c1d7f9e-0000-4000-8000-000000000000";
  EXPECT_FALSE(anchor_of(to_text(anchor)));
  for (const char* nonsense : {"", ":", "::", "a:b:c", "1:2", "x:1:"})
    EXPECT_FALSE(anchor_of(nonsense)) << nonsense;
}

TEST(HostAnchor, MissionTimeGoesOnFromItWhateverTheSystemClockShows) {
  HostAnchor anchor = anchor_host();
  const LiveClock right(anchor.unix_us, 2, anchor);
  anchor.unix_us += kHourUs;  // as if the system clock had been set back by an hour since
  const LiveClock clock(anchor.unix_us, 2, anchor);
  EXPECT_GE(clock.now(), temporal::Time(0));
  EXPECT_LT(clock.now() - right.now(), temporal::seconds(60));
  EXPECT_NEAR(static_cast<double>(unix_us(anchor) - unix_us()), static_cast<double>(kHourUs), 1e6);
}

TEST(SystemClockWatch, TellsOfEachStepOnce) {
  SystemClockWatch watch;
  const std::int64_t now = 1'700'000'000'000'000;
  EXPECT_FALSE(watch.judge(now, now + 200'000));
  EXPECT_THAT(watch.judge(now, now - kHourUs).value_or(""),
              testing::AllOf(HasSubstr("set back by 3600.000 s"), HasSubstr("3600.000 s ahead of it")));
  EXPECT_FALSE(watch.judge(now + 1'000'000, now + 1'000'000 - kHourUs));
  EXPECT_THAT(watch.judge(now, now).value_or(""), HasSubstr("set forward by 3600.000 s and agrees"));
  EXPECT_THAT(watch.judge(now, now + 300'000'000).value_or(""), HasSubstr("300.000 s behind it"));
}

class AnchorFile : public testing::Test {
 protected:
  AnchorFile() { fs::create_directories(folder); }
  ~AnchorFile() override { fs::remove_all(folder); }
  const fs::path folder = fs::temp_directory_path() / ("roci_anchor_" + std::to_string(::getpid()));
};

TEST_F(AnchorFile, ServicesThatStartAtOnceHaveOneAnchor) {
  std::vector<std::optional<HostAnchor>> found(16);
  {
    std::vector<std::jthread> starts;
    for (auto& one : found) starts.emplace_back([&] { one = launch::kept_anchor(folder, 0); });
  }
  ASSERT_TRUE(found[0]);
  for (const auto& one : found) EXPECT_EQ(one, found[0]);
  EXPECT_EQ(launch::kept_anchor(folder, 0), found[0]) << "and so has each later start";
}

TEST_F(AnchorFile, OneOfAnEarlierStartOfTheHostIsReplaced) {
  std::ofstream(folder / launch::kAnchorFile) << "0c1d7f9e-0000-4000-8000-000000000000:1:2";
  const auto anchor = launch::kept_anchor(folder, 0);
  ASSERT_TRUE(anchor);
  EXPECT_NE(anchor->unix_us, 2);
  EXPECT_EQ(launch::kept_anchor(folder, 0), anchor);
}

TEST_F(AnchorFile, AClockThatNobodyHasSetYetIsNoAnchor) {
  EXPECT_FALSE(launch::kept_anchor(folder, unix_us() + kHourUs));
  EXPECT_TRUE(launch::kept_anchor(folder, 0));
}

TEST_F(AnchorFile, ALinkIsNotFollowed) {
  std::ofstream(folder / "precious") << "precious";
  fs::create_symlink(folder / "precious", folder / launch::kAnchorFile);
  EXPECT_THROW(launch::kept_anchor(folder, 0), std::system_error);
  EXPECT_EQ(fs::file_size(folder / "precious"), 8U);
}

}  // namespace
}  // namespace roci::services::clock
