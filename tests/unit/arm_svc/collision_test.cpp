#include "arm_svc/collision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "arm_svc/sampling.hpp"
#include "core/kinematics/forward.hpp"
#include "tests/unit/arm_svc/arms.hpp"

namespace roci::arm {
namespace {

using kinematics::Arm;
using kinematics::Capsule;
using kinematics::JointVector;
using test::coordinates;

struct Segment {
  Eigen::Vector3d a, b;
};

// Shortest distance of two segments by alternating projection from several starts; slow and independent of
// FCL.
double distance(const Segment& s, const Segment& t) {
  double best = 1e9;
  for (double start : {0.0, 0.5, 1.0}) {
    double u = start;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d p = s.a + u * (s.b - s.a);
      const double v = std::clamp((p - t.a).dot(t.b - t.a) / (t.b - t.a).squaredNorm(), 0.0, 1.0);
      const Eigen::Vector3d q = t.a + v * (t.b - t.a);
      u = std::clamp((q - s.a).dot(s.b - s.a) / (s.b - s.a).squaredNorm(), 0.0, 1.0);
      best = std::min(best, (s.a + u * (s.b - s.a) - q).norm());
    }
  }
  return best;
}

Segment segment_of(const Arm& arm, std::size_t body, const std::vector<Eigen::Isometry3d>& poses) {
  const auto& shape = arm.bodies[body].shapes.front();
  const double half = 0.5 * std::get<Capsule>(shape.form).length;
  const Eigen::Isometry3d pose = poses[body] * shape.pose;
  return {pose * Eigen::Vector3d(0, 0, -half), pose * Eigen::Vector3d(0, 0, half)};
}

TEST(Collision, AgreesWithSegmentDistancesOnCapsuleArms) {
  constexpr double kMargin = 0.01, kRadius = 0.04;
  std::mt19937_64 rng(12);
  Arm arm = test::all_arms()[3].arm;
  for (std::size_t b = 0; b < arm.bodies.size(); ++b) {
    const Eigen::Isometry3d beside(Eigen::Translation3d(0.15, 0, 0));
    arm.bodies[b].shapes.push_back({"link" + std::to_string(b), beside, Capsule{kRadius, 0.1}});
  }
  const CollisionChecker checker(arm, {std::nullopt, kMargin, {}});
  int hits = 0, compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const JointVector q = sample_coordinates(arm, rng);
    const auto poses = kinematics::body_poses(arm, q);
    double closest = 1e9;
    for (std::size_t a = 0; a < arm.bodies.size(); ++a) {
      for (std::size_t b = a + 2; b < arm.bodies.size(); ++b) {
        closest = std::min(closest, distance(segment_of(arm, a, poses), segment_of(arm, b, poses)));
      }
    }
    const double gap = closest - 2 * (kRadius + kMargin);
    if (std::abs(gap) < 1e-3) continue;
    ++compared;
    hits += gap < 0 ? 1 : 0;
    EXPECT_EQ(checker.contact(q).has_value(), gap < 0) << q.transpose() << " gap " << gap;
  }
  EXPECT_GT(compared, 250);
  EXPECT_GT(hits, 20);
  EXPECT_LT(hits, compared - 20);
}

TEST(Collision, NamesWhatTouches) {
  const ArmSetup setup = test::rover_setup();
  const CollisionChecker checker(setup.arm, setup.collision);
  EXPECT_FALSE(checker.contact(coordinates({0, -1.2, 1.5, 0.6, 0})));
  const auto ground = checker.contact(coordinates({0, 0.6, 0.8, 0, 0}));
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->second, "ground");
  const auto deck = checker.contact(coordinates({2.6, 0.0, 0.6, 0, 0}));
  ASSERT_TRUE(deck);
  EXPECT_EQ(deck->second, "deck");
  const auto mast = checker.contact(coordinates({1.87, -0.6, 0, 0, 0}));
  ASSERT_TRUE(mast);
  EXPECT_EQ(mast->second, "mast");
}

TEST(Collision, GroundAndAllowedPairsAreParameters) {
  ArmSetup setup = test::rover_setup();
  const JointVector low = coordinates({0, 0.6, 0.8, 0, 0});
  setup.collision.ground_z.reset();
  const auto in_space = CollisionChecker(setup.arm, setup.collision).contact(low);
  EXPECT_FALSE(in_space) << in_space->first << " touches " << in_space->second;
  const JointVector at_mast = coordinates({1.87, -0.6, 0, 0, 0});
  const auto touching = CollisionChecker(setup.arm, setup.collision).contact(at_mast);
  ASSERT_TRUE(touching);
  for (const char* link : {"upper_arm", "forearm", "wrist", "scoop"})
    setup.collision.may_touch.push_back({"mast", link});
  EXPECT_FALSE(CollisionChecker(setup.arm, setup.collision).contact(at_mast));
}

// A line that the margin-wide sampling calls free has no contact of the true shapes at a hundred times its
// density.
TEST(Collision, FreeLinesAreFreeAtAnyDensity) {
  ArmSetup setup = test::rover_setup();
  for (double bearing : {-1.5, -0.7, 0.2, 1.1}) {  // wires that a coarse sampling jumps over
    kinematics::CollisionShape wire{"wire", Eigen::Isometry3d::Identity(), Capsule{0.001, 0.6}};
    wire.pose.translation() = Eigen::Vector3d(0.42 + 0.8 * std::cos(bearing), 0.8 * std::sin(bearing), 0.1);
    setup.arm.bodies[0].shapes.push_back(wire);
  }
  for (std::size_t body = 2; body < setup.arm.bodies.size(); ++body) {
    for (auto& shape : setup.arm.bodies[body].shapes) shape.form = Capsule{0.001, 0.4};
  }
  const CollisionChecker checker(setup.arm, setup.collision);
  CollisionRules bare = setup.collision;
  bare.margin = 1e-9;
  const CollisionChecker exact(setup.arm, bare);
  std::mt19937_64 rng(13);
  int free_lines = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const JointVector from = sample_coordinates(setup.arm, rng), to = sample_coordinates(setup.arm, rng);
    if (!checker.line_is_free(from, to)) continue;
    ++free_lines;
    for (int i = 0; i <= 1000; ++i) ASSERT_FALSE(exact.contact(from + (to - from) * (i / 1000.0)));
  }
  EXPECT_GT(free_lines, 20);
}

}  // namespace
}  // namespace roci::arm
