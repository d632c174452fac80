#include "arm_svc/estimate.hpp"

#include <gtest/gtest.h>

#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

std::vector<PlacePair> all_pairs(const MotionModel& model) {
  std::vector<PlacePair> tuples;
  for (const auto& from : model.poses()) {
    for (const auto& to : model.poses()) tuples.push_back({{from.name}, {to.name}});
  }
  return tuples;
}

TEST(Estimate, AnswersEachTupleInOrderWithItsMotion) {
  const MotionModel model(test::rover_setup());
  EstimateCache cache;
  auto tuples = all_pairs(model);
  tuples.push_back({{"stow"}, {"nowhere"}});
  const auto estimates = cache.estimate(model, tuples);
  ASSERT_EQ(estimates.size(), tuples.size());
  for (std::size_t i = 0; i < tuples.size(); ++i) {
    const Motion motion = model.motion(tuples[i].from, tuples[i].to);
    EXPECT_EQ(estimates[i].status, motion.status);
    EXPECT_EQ(estimates[i].duration_s, motion.duration_s);
    EXPECT_EQ(estimates[i].energy_j, motion.energy_j);
  }
  EXPECT_EQ(estimates.back().status, MotionStatus::unknown_pose);
}

TEST(Estimate, KeepsEachMotionOnceAndForgetsThemWithTheModel) {
  const MotionModel model(test::rover_setup());
  EstimateCache cache;
  const auto tuples = all_pairs(model);
  int asked = 0;
  const auto counting = [&asked] { return ++asked, false; };
  const auto first = cache.estimate(model, tuples, counting);
  EXPECT_EQ(cache.size(), tuples.size());
  EXPECT_GT(asked, 0);
  asked = 0;
  const auto second = cache.estimate(model, tuples, counting);
  EXPECT_EQ(asked, 0) << "everything was known";
  EXPECT_EQ(first[1].duration_s, second[1].duration_s);

  ArmSetup slow = test::rover_setup();
  slow.arm.joints[1].limits.velocity *= 0.5;
  const auto third = cache.estimate(MotionModel(slow), tuples);
  EXPECT_GT(third[1].duration_s, first[1].duration_s);
}

TEST(Estimate, KnowsAPlaceByItsJointsWhateverItsName) {
  const MotionModel model(test::rover_setup());
  EstimateCache cache;
  const kinematics::JointVector ready = model.poses()[1].joints;
  const auto named = cache.estimate(model, std::vector<PlacePair>{{{"ready"}, {"sampling"}}});
  const auto given = cache.estimate(model, std::vector<PlacePair>{{{"arm-here", ready}, {"sampling"}}});
  EXPECT_EQ(cache.size(), 1u);
  EXPECT_EQ(named[0].duration_s, given[0].duration_s);
  const kinematics::JointVector moved = ready + kinematics::JointVector::Constant(5, 0.05);
  const auto other = cache.estimate(model, std::vector<PlacePair>{{{"arm-here", moved}, {"sampling"}}});
  EXPECT_NE(named[0].duration_s, other[0].duration_s);
}

TEST(Estimate, CancelledAndUnknownTuplesAreNotKept) {
  const MotionModel model(test::rover_setup());
  EstimateCache cache;
  const std::vector<PlacePair> tuples = {{{"stow"}, {"sampling"}}, {{"stow"}, {"nowhere"}}};
  EXPECT_EQ(cache.estimate(model, tuples, [] { return true; })[0].status, MotionStatus::cancelled);
  EXPECT_EQ(cache.size(), 0u);
  EXPECT_EQ(cache.estimate(model, tuples)[0].status, MotionStatus::found);
  EXPECT_EQ(cache.size(), 1u);
}

}  // namespace
}  // namespace roci::arm
