#include "services/link/link_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::services::link {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::Pair;

LinkTable table() {
  Link up{"uplink", {"ground", "rover"}};
  up.light_time = 4s;
  Link radio{"radio", {"rover", "scout"}};
  Link engine{"engine", {"planner_svc", "exec_svc"}};
  engine.light_time = 1s;
  return {{up, radio, engine},
          {{"exec_svc", "rover"}, {"scout.exec", "scout"}, {"planner_svc", ""}, {"sim_svc", ""}},
          1};
}

std::string joined(const Party& a, const Party& b) {
  const LinkTable links = table();
  const auto found = links.passage(a, b);
  return found ? found->link->name + " from " + std::to_string(found->sender_end) : "none";
}

TEST(LinkTable, JoinsRobotsServicesAndTheGround) {
  const Party exec{"exec_svc", "rover"}, scout{"scout.exec", "scout"}, planner{"planner_svc"};
  EXPECT_EQ(joined({"roci-1", "", true}, exec), "uplink from 0");
  EXPECT_EQ(joined(exec, {"roci-1", "", true}), "uplink from 1");
  EXPECT_EQ(joined({"ground"}, exec), "uplink from 0");  // a service of that name is the ground
  EXPECT_EQ(joined(scout, exec), "radio from 1");
  EXPECT_EQ(joined(planner, exec), "engine from 0");
}

TEST(LinkTable, KnowsWhichNamesAreThoseOfRobots) {
  EXPECT_TRUE(table().has_robot("scout"));
  EXPECT_FALSE(table().has_robot("ground"));
  EXPECT_FALSE(table().has_robot(""));
}

TEST(LinkTable, WhomNoLinkJoinsIsNotAffected) {
  const Party exec{"exec_svc", "rover"};
  EXPECT_EQ(joined({"sim_svc"}, exec), "none");
  EXPECT_EQ(joined({"arm_svc", "rover"}, exec), "none");
  EXPECT_EQ(joined({"planner_svc"}, {"scout.exec", "scout"}), "none");
  EXPECT_EQ(joined(exec, exec), "none");
}

TEST(LinkTable, OfTwoLinksTheFirstCounts) {
  LinkTable links({{"a", {"rover", "scout"}}, {"b", {"exec_svc", "scout"}}}, {}, 1);
  EXPECT_EQ(links.passage({"exec_svc", "rover"}, {"x", "scout"})->link->name, "a");
}

TEST(LinkTable, RoundTripsAreTwiceTheLightTime) {
  const LinkTable links = table();
  EXPECT_EQ(links.round_trip({"roci-1", "", true}, links.party("exec_svc")), 8s);
  EXPECT_EQ(links.round_trip(links.party("sim_svc"), links.party("exec_svc")), std::nullopt);
  EXPECT_THAT(links.round_trips(links.party("exec_svc")),
              ElementsAre(Pair("planner_svc", 2s), Pair("scout.exec", 0s)));
}

}  // namespace
}  // namespace roci::services::link
