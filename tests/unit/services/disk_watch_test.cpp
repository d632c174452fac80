#include "services/launch/disk_watch.hpp"

#include <gtest/gtest.h>

namespace roci::services::launch {
namespace {

std::string code(DiskWatch& watch, std::uintmax_t left) {
  const auto change = watch.judge(left, "/run");
  return change ? change->code : "";
}

TEST(DiskWatch, AFullDiskIsToldOnceAndItsRoomOnce) {
  DiskWatch watch;
  EXPECT_EQ(code(watch, DiskWatch::kFull), "");
  EXPECT_EQ(code(watch, DiskWatch::kFull - 1), "disk.full");
  EXPECT_EQ(code(watch, 0), "");
  EXPECT_EQ(code(watch, DiskWatch::kRoom - 1), "") << "it may be full again at once";
  EXPECT_EQ(code(watch, DiskWatch::kRoom), "disk.room");
  EXPECT_EQ(code(watch, 0), "disk.full");
}

// Errors alone are printed without a view of the mission (--headless).
TEST(DiskWatch, AFullDiskIsAnErrorThatNamesTheFolder) {
  DiskWatch watch;
  const auto change = watch.judge(12, "/run/folder");
  ASSERT_TRUE(change);
  EXPECT_EQ(change->severity, v1::SEVERITY_ERROR);
  EXPECT_TRUE(change->text.starts_with("the disk of /run/folder has 12 bytes left")) << change->text;
}

}  // namespace
}  // namespace roci::services::launch
