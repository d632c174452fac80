#include "exec_svc/journal/crash_points.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace roci::exec {

using journal::CrashPoints;

namespace {

int deaths(const char* setting, std::uint32_t incarnation = 1) {
  int count = 0;
  CrashPoints points(setting, incarnation, [&count] { ++count; });
  for (int i = 0; i < 3; ++i) {
    points.pass("after-send");
    if (count > 0) return i + 1;
  }
  return count;
}

TEST(CrashPoints, DieTheNthTimeInTheirIncarnation) {
  EXPECT_EQ(deaths(""), 0);
  EXPECT_EQ(deaths("after-send:1"), 1);
  EXPECT_EQ(deaths("after-send:3"), 3);
  EXPECT_EQ(deaths("after-send:4"), 0);
  EXPECT_EQ(deaths("during-send:1"), 0);
  EXPECT_EQ(deaths("after-send:1", 2), 0);
  EXPECT_EQ(deaths("during-send:1,after-send:2", 2), 2);
}

TEST(CrashPoints, AreNamedWhenTheSettingIsWrong) {
  for (const char* wrong : {"after-lunch:1", "after-send", "after-send:", "after-send:0", "after-send:x"}) {
    try {
      CrashPoints points(wrong, 1, [] {});
      FAIL() << wrong;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("before-write-ahead")) << wrong;
    }
  }
}

}  // namespace
}  // namespace roci::exec
