#include "planner_svc/temporal_pddl/constraints/constraint_code.hpp"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>

#include "planner_svc/temporal_pddl/search/plan_prefix.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using constraints::BoundTable;
using constraints::decode;
using constraints::encode;
using constraints::kMaxSteps;
using constraints::StepConstraint;
using temporal::Duration;
using temporal::no_bound;

constexpr Duration kEpsilon{1000};

std::vector<std::uint8_t> code_of(const StepConstraint& constraint, BoundTable& bounds) {
  std::vector<std::uint8_t> code;
  encode(constraint, kEpsilon, bounds, code);
  return code;
}

// R29. Head: j = 5 (15 bits), i = 3 (15 bits), kind (2 bits) = 0x000a000c + kind, least significant byte
// first.
TEST(ConstraintCode, FourGoldenEncodings) {
  BoundTable bounds;
  EXPECT_EQ(code_of({3, 5, Duration{0}, no_bound}, bounds),
            (std::vector<std::uint8_t>{0x0c, 0x00, 0x0a, 0x00}));
  EXPECT_EQ(code_of({3, 5, kEpsilon, no_bound}, bounds), (std::vector<std::uint8_t>{0x0d, 0x00, 0x0a, 0x00}));
  EXPECT_EQ(code_of({3, 5, Duration{7}, Duration{7}}, bounds),
            (std::vector<std::uint8_t>{0x0e, 0x00, 0x0a, 0x00, 0x00}));
  EXPECT_EQ(code_of({3, 5, Duration{7}, Duration{9}}, bounds),
            (std::vector<std::uint8_t>{0x0f, 0x00, 0x0a, 0x00, 0x00, 0x01}));
}

TEST(ConstraintCode, LargestStepsAndLongIndices) {
  BoundTable bounds;
  for (int i = 0; i < 300; ++i) bounds.intern(Duration{i});
  EXPECT_EQ(code_of({32765, 32766, Duration{299}, Duration{299}}, bounds),
            (std::vector<std::uint8_t>{0xf6, 0xff, 0xfd, 0xff, 0xab, 0x02}));
}

TEST(ConstraintCode, RefusesStep32768) {
  BoundTable bounds;
  EXPECT_THROW(code_of({0, 32767, kEpsilon, no_bound}, bounds), std::length_error);
  EXPECT_THROW(code_of({32767, 0, kEpsilon, no_bound}, bounds), std::length_error);
}

// R30: 32,767 steps are a plan, and one more is not, be it taken or still needed to end what runs.
TEST(PlanPrefix, IsTooLongFromStep32768On) {
  search::PlanPrefix prefix;
  prefix.steps.resize(32767);
  EXPECT_FALSE(search::is_too_long(prefix));
  prefix.steps.resize(32768);
  EXPECT_TRUE(search::is_too_long(prefix));
  prefix.steps.resize(32766);
  prefix.running.resize(1);
  EXPECT_FALSE(search::is_too_long(prefix));
  prefix.steps.resize(32767);
  EXPECT_TRUE(search::is_too_long(prefix));
}

TEST(ConstraintCode, RandomListsRoundTrip) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 300; ++round) {
    BoundTable bounds;
    std::vector<StepConstraint> constraints;
    std::vector<std::uint8_t> code;
    for (std::size_t n = random() % 40; n > 0; --n) {
      StepConstraint c{static_cast<std::uint32_t>(random() % kMaxSteps),
                       static_cast<std::uint32_t>(random() % kMaxSteps)};
      const auto some = [&] { return Duration(static_cast<std::int64_t>(random() >> (1 + random() % 62))); };
      switch (random() % 5) {
        case 0:
          break;
        case 1:
          c.lower = kEpsilon;
          break;
        case 2:
          c.lower = c.upper = some();
          break;
        case 3:
          c.lower = some();
          c.upper = c.lower > no_bound - Duration{100} ? no_bound : c.lower + Duration{random() % 100};
          break;
        case 4:
          c.lower = some();
          break;
      }
      constraints.push_back(c);
      encode(c, kEpsilon, bounds, code);
    }
    std::vector<StepConstraint> decoded;
    decode(code, kEpsilon, bounds, decoded);
    EXPECT_EQ(decoded, constraints);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
