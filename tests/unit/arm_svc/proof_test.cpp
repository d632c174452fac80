// "No way" is proved or not said; what was not found is searched harder when it is asked again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm_svc/estimate.hpp"
#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using test::coordinates;
using testing::HasSubstr;

// A fin along the shoulder's axis and a post in the way of its sweep: before and after lie on either side.
ArmSetup shut_setup() {
  ArmSetup setup = test::rover_setup();
  kinematics::CollisionShape fin{"fin", Eigen::Isometry3d::Identity(), kinematics::Box{{0.02, 0.8, 0.02}}};
  fin.pose.translation() = Eigen::Vector3d(0, 0.5, 0);
  kinematics::CollisionShape post{"post", Eigen::Isometry3d::Identity(), kinematics::Box{{0.05, 0.05, 3}}};
  post.pose.translation() = Eigen::Vector3d(0.42 - 0.7 * std::sin(0.8), -0.10 + 0.7 * std::cos(0.8), 0);
  setup.arm.bodies[2].shapes = {fin};
  setup.arm.bodies[0].shapes = {post};
  setup.search_iterations = 10;
  setup.poses = {{"before", coordinates({0, -1, 0, 0, 0})}, {"after", coordinates({1.6, -1, 0, 0, 0})}};
  return setup;
}

TEST(Proof, LimitsReachAndContactOfGivenJointsAreProofs) {
  ArmSetup setup = test::rover_setup();
  setup.poses.push_back({"far", ToolTarget{{3, 0, 0}, {}, {}}, {}, "poses.yaml:9:3"});
  setup.poses.push_back({"bent", coordinates({0, 2.0, 0, 0, 0}), {}, "poses.yaml:10:3"});
  setup.poses.push_back({"on_deck", coordinates({2.6, 0.0, 0.6, 0, 0})});
  const MotionModel model(setup);
  const auto expect_proof = [&](const Place& to, MotionStatus status, const std::string& words) {
    const Motion motion = model.motion({"stow"}, to);
    EXPECT_EQ(motion.status, status) << to.name;
    EXPECT_TRUE(motion.proved) << to.name;
    EXPECT_THAT(motion.detail, HasSubstr(words));
  };
  expect_proof({"far"}, MotionStatus::unreachable,
               "poses.yaml:9:3: pose 'far' is out of the arm's reach, by 1.");
  expect_proof({"bent"}, MotionStatus::unreachable,
               "poses.yaml:10:3: pose 'bent' is out of the arm's reach or limits: joint 'shoulder'");
  expect_proof({"on_deck"}, MotionStatus::in_collision, "touches deck");
  expect_proof({"here", coordinates({9, 0, 0, 0, 0})}, MotionStatus::unreachable, "beyond the limits");
  expect_proof({"spot", {}, Eigen::Vector3d(0, 0, 9)}, MotionStatus::unreachable, "out of the arm's reach");
}

TEST(Proof, WhatIsOnlyNotFoundIsNone) {
  ArmSetup setup = test::rover_setup();
  // Within the sum of the links, but with the tool turned as the five joints cannot turn it there.
  setup.poses.push_back({"askew", ToolTarget{{1.0, 0.5, 0.2},
                                             {},
                                             Eigen::Quaterniond(Eigen::AngleAxisd(
                                                 1.5, Eigen::Vector3d(1, 2, 3).normalized()))}});
  setup.poses.push_back({"buried", ToolTarget{{0.95, 0, -0.7}, {}, {}}});
  const MotionModel model(setup);
  const Motion askew = model.motion({"stow"}, {"askew"}), buried = model.motion({"stow"}, {"buried"});
  EXPECT_EQ(askew.status, MotionStatus::unsolved);
  EXPECT_THAT(askew.detail, HasSubstr("no joint values were found"));
  EXPECT_FALSE(askew.proved);
  EXPECT_EQ(buried.status, MotionStatus::in_collision);
  EXPECT_FALSE(buried.proved) << "other joint values might put the tool there";
  const MotionModel shut(shut_setup());
  const Motion motion = shut.motion({"before"}, {"after"});
  EXPECT_EQ(motion.status, MotionStatus::no_path);
  EXPECT_FALSE(motion.proved) << "a search that ended proves nothing";
}

TEST(Proof, NothingWithinTheLimitsIsOutOfReach) {
  std::mt19937_64 rng(8);
  std::vector<test::NamedArm> arms = test::all_arms();
  arms.push_back({"rail", test::rail_setup().arm});
  for (const auto& [name, arm] : arms) {
    const kinematics::ReachBound bound = kinematics::reach_bound(arm);
    double farthest = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      const Eigen::Vector3d tool = kinematics::tool_pose(arm, sample_coordinates(arm, rng)).translation();
      ASSERT_LE(bound.excess(tool), 1e-9) << name;
      farthest = std::max(farthest, (tool - bound.from).norm());
    }
    EXPECT_GT(farthest, 0.5 * bound.radius) << name << ": a bound that says something";
    EXPECT_GT(bound.excess(bound.to + Eigen::Vector3d(0, 0, bound.radius + 0.1)), 0.09);
  }
}

TEST(AskedAgain, SearchesTwiceAsHardEachRequestUpToABound) {
  const MotionModel model(shut_setup());
  EstimateCache cache;
  const std::vector<PlacePair> pairs{{{"before"}, {"after"}}, {{"before"}, {"after"}}};
  std::vector<std::string> said;
  for (int request = 0; request < 7; ++request) {
    cache.begin_request();
    const auto estimates = cache.estimate(model, pairs);
    EXPECT_EQ(estimates[0].detail, estimates[1].detail) << "one request searches once";
    EXPECT_FALSE(estimates[0].proved);
    said.push_back(estimates[0].detail);
  }
  for (std::size_t i = 0; i < said.size(); ++i)
    EXPECT_THAT(said[i],
                HasSubstr("within " + std::to_string(10 * std::min(16, 1 << i)) + " search iterations"));
}

// A table of more motions than are kept is not planned anew as a whole, and the effort goes on to grow.
TEST(AskedAgain, AFullCacheKeepsTheEffortAndWhatItHasFound) {
  const MotionModel model(shut_setup());
  EstimateCache cache(10);
  std::vector<PlacePair> pairs;
  for (int i = 1; i <= 30; ++i)
    pairs.push_back({{"before"}, {"near", coordinates({-0.01 * i, -1, 0, 0, 0})}});
  const PlacePair shut{{"before"}, {"after"}};
  pairs.insert(pairs.begin() + 15, shut);
  int planned = 0;
  const auto counting = [&planned] {
    return ++planned, false;
  };  // once for each motion that is a straight line
  for (int request = 0; request < 7; ++request) {
    cache.begin_request();
    const auto estimates = cache.estimate(model, pairs);
    EXPECT_THAT(estimates[15].detail, HasSubstr("within " + std::to_string(10 * std::min(16, 1 << request)) +
                                                " search iterations"));
  }
  cache.begin_request();
  cache.estimate(model, pairs, counting);
  EXPECT_EQ(planned, 20) << "the others are kept";
  EXPECT_LE(cache.size(), 20U);
  // What is not asked for any more makes room for what is.
  pairs.assign(1, {{"before"}, {"far", coordinates({-0.5, -1, 0, 0, 0})}});
  for (int request = 0; request < 100; ++request) {
    cache.begin_request();
    cache.estimate(model, pairs);
  }
  planned = 0;
  cache.estimate(model, pairs, counting);
  EXPECT_EQ(planned, 0);
  cache.begin_request();
  EXPECT_THAT(cache.estimate(model, {&shut, 1})[0].detail, HasSubstr("within 160 search iterations"))
      << "while there is room, what was not found is not forgotten";
}

// A greater effort finds what a smaller one finds.
TEST(AskedAgain, KeepsWhatWasFound) {
  const MotionModel model(test::rover_setup());
  const Motion once = model.plan({{"stow"}, {"deposit"}, {}, 1}),
               hard = model.plan({{"stow"}, {"deposit"}, {}, 16});
  ASSERT_EQ(once.status, MotionStatus::found);
  EXPECT_EQ(once.duration_s, hard.duration_s);
  EXPECT_EQ(once.energy_j, hard.energy_j);
}

TEST(Positions, AreResolvedOnceAndCostAsTheJointsDo) {
  const MotionModel model(test::rover_setup());
  EstimateCache cache;
  const Place spot{"spot", {}, Eigen::Vector3d(0.9, 0.1, -0.2)};
  const ResolvedPlace resolved = cache.resolve(model, spot);
  ASSERT_EQ(resolved.status, MotionStatus::found) << resolved.detail;
  const auto estimates =
      cache.estimate(model, std::vector<PlacePair>{{{"stow"}, spot}, {{"stow"}, {"there", resolved.joints}}});
  EXPECT_EQ(estimates[0].status, MotionStatus::found);
  EXPECT_EQ(estimates[0].duration_s, estimates[1].duration_s);
  EXPECT_EQ(cache.size(), 1U);
}

}  // namespace
}  // namespace roci::arm
