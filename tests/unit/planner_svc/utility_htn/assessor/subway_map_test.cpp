#include "planner_svc/utility_htn/assessor/subway_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <vector>

namespace {

namespace assessor = roci::planner::utility_htn::assessor;
namespace model = roci::planner::utility_htn::model;
using assessor::Stop, assessor::SubwayState;
using testing::ElementsAre;

constexpr std::array<std::array<double, 3>, 3> kVisual{{{0.5, 0.9, 0.7}, {0.2, 0.1, 0.3}, {0.6, 0.6, 0.8}}};

model::SubwayMap three_by_three(const std::array<double, 3>& values) {
  model::SubwayMap map;
  for (std::uint32_t site = 0; site < 3; ++site) {
    model::Site& added = map.sites.emplace_back();
    added.name = "site_" + std::to_string(site);
    added.value.constant = values[site];
    for (std::uint32_t target = 0; target < 3; ++target)
      added.targets.push_back({3 * site + target, 3 * site + target, {kVisual[site][target], {}, 1}});
  }
  return map;
}

std::vector<std::uint32_t> sampled_in(const model::SubwayMap& map, std::bitset<9> positive) {
  std::vector<double> signatures(9, 0.0);
  std::vector<std::uint32_t> out;
  while (const auto next = SubwayState(map, {}, signatures).next()) {
    const std::uint32_t target = 3 * next->site + next->target;
    out.push_back(target);
    signatures[target] = positive[target] ? 2 : 1;
  }
  return out;
}

// Figure 3 told once more: sites by value, targets by visual weight, on to the next site with the first negative.
TEST(SubwayMap, LeadsAsFigureThreeDoesInEachOfTheOutcomes) {
  const model::SubwayMap map = three_by_three({0.4, 0.9, 0.6});
  for (unsigned outcome = 0; outcome < 512; ++outcome) {
    const std::bitset<9> positive(outcome);
    std::vector<std::uint32_t> expected;
    for (const std::vector<std::uint32_t>& site :
         {std::vector<std::uint32_t>{5, 3, 4}, {8, 6, 7}, {1, 2, 0}}) {
      for (const std::uint32_t target : site) {
        expected.push_back(target);
        if (!positive[target]) break;
      }
    }
    ASSERT_EQ(sampled_in(map, positive), expected) << positive;
  }
}

TEST(SubwayMap, TakesNoMoreSamplesAtASiteThanItSays) {
  model::SubwayMap map = three_by_three({0.4, 0.9, 0.6});
  map.most_samples = 2;
  EXPECT_THAT(sampled_in(map, 511), ElementsAre(5, 3, 8, 6, 1, 2));
}

TEST(SubwayMap, PlannedSamplesCountAsPositiveUntilTheirSignatureIsKnown) {
  const model::SubwayMap map = three_by_three({0.4, 0.9, 0.6});
  std::vector<double> signatures(9, 0.0);
  SubwayState planned(map, {}, signatures);
  planned.plan({1, 2});
  EXPECT_EQ(planned.next(), (Stop{1, 0}));
  signatures[5] = 1;
  SubwayState known(map, {}, signatures);
  known.plan({1, 2});
  EXPECT_EQ(known.next(), (Stop{2, 2}));
}

TEST(SubwayMap, ASiteThatIsBegunGoesOnThoughAnotherHasBecomeMoreValuable) {
  std::vector<double> signatures(9, 0.0);
  signatures[5] = 2;
  EXPECT_EQ(SubwayState(three_by_three({1.0, 0.1, 1.0}), {}, signatures).next(), (Stop{1, 0}));
  signatures[5] = 1;
  EXPECT_EQ(SubwayState(three_by_three({0.7, 0.1, 0.8}), {}, signatures).next(), (Stop{2, 2}));
}

TEST(SubwayMap, LeadsPastTargetsThatNobodyAsksForAnyMore) {
  const std::vector<double> signatures(9, 0.0);
  SubwayState state(three_by_three({0.4, 0.9, 0.6}), {}, signatures);
  state.close({1, 2});
  EXPECT_EQ(state.next(), (Stop{1, 0}));
  state.close({1, 0});
  state.close({1, 1});
  EXPECT_EQ(state.next(), (Stop{2, 2}));
}

TEST(SubwayMap, ValuesFollowFromAllSignaturesAndTheVisualWeight) {
  const model::SubwayMap map = three_by_three({0.4, 0.9, 0.6});
  std::vector<double> signatures(9, 0.0);
  EXPECT_DOUBLE_EQ(SubwayState(map, {}, signatures).estimated({0, 1}), 0.9 * 0.4);
  signatures[5] = 2;  // elsewhere: a quarter of a sample
  EXPECT_DOUBLE_EQ(SubwayState(map, {}, signatures).estimated({0, 1}), 0.9 * (2 * 0.4 + 0.25) / 2.25);
  signatures[0] = 1;
  EXPECT_DOUBLE_EQ(SubwayState(map, {}, signatures).estimated({0, 1}), 0.9 * (2 * 0.4 + 0.25) / 3.25);
  signatures[2] = 2;
  EXPECT_DOUBLE_EQ(SubwayState(map, {}, signatures).estimated({0, 1}), 0.9 * (2 * 0.4 + 1.25) / 4.25);
}

}  // namespace
