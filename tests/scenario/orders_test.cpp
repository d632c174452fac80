// Orders of the ground through real processes: each kind, given twice, refused, with the executive killed
// between an order and its acknowledgement, and after a take-over by the standby.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/scenario/scripted_world/flight.hpp"

namespace roci::scenario {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr int kRefused = 2, kApplied = 3;  // OrderStage of idl/order.idl

constexpr char kGround[] =
    "\ncontingencies:\n"
    "  wipe: {commands: [{owner: sim_svc, component: camera, command: stop}]}\n"
    "ground:\n  values: [rover.go]\n  uploads: [contingencies.wipe]\n";

struct Case {
  const char* name;
  const char* dds;
  const char* crash;
  const char* more;
  int starts;  // of the executive, at least
};

class Orders : public ::testing::TestWithParam<Case> {};

TEST_P(Orders, AreObeyedOnceAnsweredAndKept) {
  const Case& one = GetParam();
  const ScriptedFlight flight = fly_scripted(std::string("ROCI_TEST_SCRIPT=orders ROCI_CRASH=") + one.crash,
                                             std::string("--dds ") + one.dds + one.more, kGround);
  EXPECT_EQ(flight.exit_code, 0);
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  EXPECT_THAT(flight.images, ElementsAre("image-look", "image-a", "image-b", "image-c", "image-e", "image-e",
                                         "image-end", "image-end"))
      << "d was dropped, e failed and was launched again, end was stopped and launched again";
  ASSERT_TRUE(flight.heard.is_object());
  const nlohmann::json& heard = flight.heard["orders"];
  std::vector<std::string> applied;
  for (const auto& [id, status] : heard.items())
    if (status["stage"] == kApplied) applied.push_back(id);
  EXPECT_THAT(applied, ElementsAre("answer", "approve", "drop", "e1", "e2", "go", "hold", "relaunch",
                                   "relaunch-2", "release", "safe", "upload"));
  EXPECT_FALSE(heard.contains("for-another")) << "it is for another robot";
  ASSERT_EQ(heard["garbled"]["stage"], kRefused);
  EXPECT_THAT(heard["garbled"]["reason"].get<std::string>(), HasSubstr("checksum"));
  ASSERT_EQ(heard["refused"]["stage"], kRefused);
  EXPECT_THAT(heard["refused"]["reason"].get<std::string>(), HasSubstr("no plan runs"));
  EXPECT_EQ(heard["relaunch"]["plan"], 2);
  EXPECT_EQ(heard["relaunch-2"]["plan"], 3);
  EXPECT_EQ(flight.heard["go"], true) << "everybody sees the value";
  EXPECT_EQ(flight.heard["held"], true) << "the mission's status tells";
  EXPECT_THAT(flight.orders, Contains("ground/hold 3"));
  EXPECT_THAT(flight.orders, Contains("ground/release 3").Times(1));
  EXPECT_GE(flight.summary.value("epoch", 0), one.starts);
  EXPECT_EQ(flight.count("executive.resumed"), one.starts - 1);
  EXPECT_EQ(flight.count("journal.diverged"), 0);
  EXPECT_EQ(flight.replayed.value("same", false), true) << flight.replayed;
}

INSTANTIATE_TEST_SUITE_P(Flights, Orders,
                         ::testing::Values(Case{"undisturbed", "fastdds", "", "", 1},
                                           Case{"killed_between_order_and_acknowledgement", "cyclonedds",
                                                "after-order:1,after-order:2,after-write-ahead:12", "", 4},
                                           Case{"taken_over", "cyclonedds", "after-order:7", " --standby",
                                                2}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::scenario
