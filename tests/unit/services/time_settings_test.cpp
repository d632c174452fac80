#include "services/process/time_settings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace roci::services::process {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr char kServices[] = "services: [{name: exec_svc}, {name: sim_svc, clock: master}]\n";

TimeWatchSettings read(const std::string& text) {
  const auto file =
      std::filesystem::temp_directory_path() / ("roci_time_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(file) << text;
  return read_time_settings(mission::Entry::load(file));
}

std::string refusal(const std::string& text) {
  try {
    read(text);
    return "taken";
  } catch (const mission::FileError& error) {
    return error.what();
  }
}

TEST(TimeSettings, TheClocksMasterIsTheReferenceElseTheFirstService) {
  EXPECT_EQ(read(kServices).reference, "sim_svc");
  EXPECT_EQ(read("services: [{name: exec_svc}, {name: arm_svc}]\n").reference, "exec_svc");
  EXPECT_EQ(read(std::string(kServices) + "clock: {reference: exec_svc}\n").reference, "exec_svc");
  EXPECT_EQ(read("name: x\n").reference, "");
}

TEST(TimeSettings, BoundsHaveDefaults) {
  const TimeWatchSettings defaults = read(kServices);
  EXPECT_EQ(defaults.bounds.offset, 250ms);
  EXPECT_EQ(defaults.bounds.drift_ppm, 200);
  const TimeWatchSettings given =
      read(std::string(kServices) + "clock: {offset_s: 0.1, drift_ppm: 50, period_s: 2}\n");
  EXPECT_EQ(given.bounds.offset, 100ms);
  EXPECT_EQ(given.bounds.drift_ppm, 50);
  EXPECT_EQ(given.period_s, 2);
}

TEST(TimeSettings, BadInputIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal(std::string(kServices) + "clock: {offset_s: 0}\n"), HasSubstr(".yaml:2:"));
  EXPECT_THAT(refusal(std::string(kServices) + "clock: {bound: 1}\n"), HasSubstr("unknown key 'bound'"));
  EXPECT_THAT(refusal(std::string(kServices) + "clock: {reference: moon}\n"), HasSubstr("no service 'moon'"));
}

}  // namespace
}  // namespace roci::services::process
