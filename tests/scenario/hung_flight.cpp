#include "tests/scenario/hung_flight.hpp"

#include <gtest/gtest.h>

#include "services/process/domain_claim.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

std::map<std::string, Step> fly_with(const Hang& hang) {
  const services::process::DomainClaim domain;
  const std::string quoted_sets =
      std::string(" '") + hang.returning + "' '" + hang.lost + "' '" + hang.killed + "' ";
  const Ended ended =
      run("timeout 150 " ROCI_SOURCE_DIR "/tests/scenario/hung.sh " ROCI_BINARY_DIR "/bin " ROCI_SOURCE_DIR
          "/missions/planetary " +
          std::string(hang.dds) + " " + std::to_string(domain.id()) + quoted_sets + hang.more);
  auto steps = steps_of(ended.output);
  EXPECT_EQ(steps["flying"].printed.value("phase", ""), "executing") << ended.output;
  EXPECT_EQ(steps["replaced"].exit_code, 0) << "a process that hung or was killed is still there";
  EXPECT_TRUE(steps["replay"].printed.value("same", false)) << ended.output;
  return steps;
}

}  // namespace

std::string name_of(const Hang& hang) { return std::string(hang.name) + "_" + hang.dds; }
void PrintTo(const Hang& hang, std::ostream* out) { *out << hang.name << " over " << hang.dds; }

void expect_achieved(const Hang& hang) {
  auto steps = fly_with(hang);
  EXPECT_EQ(steps["add"].exit_code, 0);
  EXPECT_EQ(steps["launch"].exit_code, 0);
  const nlohmann::json& summary = steps["launch"].printed;
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary.value("result", ""), "achieved") << summary;
  EXPECT_EQ(summary["goals"].value("achieved", 0), 4) << summary;
  EXPECT_EQ(summary["goals"].value("open", 1), 0) << summary;
  expect_done_once(steps["effects"].printed);
}

void expect_ended(const Hang& hang) {
  auto steps = fly_with(hang);
  EXPECT_EQ(steps["launch"].exit_code, 3);
  const nlohmann::json& summary = steps["launch"].printed;
  ASSERT_TRUE(summary.is_object());
  EXPECT_EQ(summary.value("result", ""), "failed");
  EXPECT_EQ(summary["goals"].value("open", 0), 3) << summary;
}

}  // namespace roci::scenario
