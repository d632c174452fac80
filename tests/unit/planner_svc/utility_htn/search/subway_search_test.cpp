#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bitset>
#include <map>

#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using roci::planner::utility_htn::assessor::SubwayAssessor;
using search::Problem, search::Toy;
using testing::ElementsAre;

// Three sites of three targets; the last site tempts with the greatest worth for the least energy.
class SubwaySearch : public testing::Test {
 protected:
  SubwaySearch() {
    for (std::uint32_t site = 0; site < 3; ++site) {
      toy.network.subway.sites.push_back({"site", {0.9 - 0.2 * site, {}, 1}, {}});
      for (std::uint32_t target = 0; target < 3; ++target) {
        const std::string name = "sample_" + std::to_string(site) + "_" + std::to_string(target);
        const model::TaskIndex sample = toy.task(name, 10, 50 - 20 * site, {0, 0.1 + 0.4 * site, 0.5}, true);
        toy.network.subway.sites[site].targets.push_back(
            {sample, static_cast<std::uint32_t>(toy.network.timelines.size()), {0.9 - 0.1 * target, {}, 1}});
        toy.network.timelines.push_back({"signature_" + name,
                                         roci::temporal::timelines::Kind::state,
                                         {"unknown", "negative", "positive"}});
      }
    }
    toy.task("panorama", 10, 20, {0, 0, 1}, true);
    toy.close();
  }
  std::vector<std::string> plan(std::bitset<9> known, std::bitset<9> positive, double budget) {
    for (std::size_t target = 0; target < 9; ++target)
      toy.now[3 + target] = !known[target] ? 0 : positive[target] ? 2 : 1;
    const SubwayAssessor assessor(toy.network, toy.chains);
    Problem problem{toy.network, toy.values, toy.chains, assessor, toy.earliest, toy.timelines[0]};
    problem.until = roci::temporal::seconds(1000);
    problem.budget = budget;
    problem.timelines_now = toy.now;
    for (model::TaskIndex target = 0; target < 9; ++target) {
      if (known[target]) problem.closed.push_back(target);
    }
    std::vector<std::string> out = toy.names(search::search(problem, 40).plan);
    std::erase(out, "panorama");
    return out;
  }
  Toy toy;
};

TEST_F(SubwaySearch, EveryPlanOfEveryOutcomeFollowsTheMap) {
  std::map<std::pair<unsigned long, unsigned long>, std::vector<std::string>> plans;
  for (unsigned long outcome = 0; outcome < 512; ++outcome) {
    const std::bitset<9> positive(outcome);
    std::bitset<9> known;
    for (std::size_t site = 0; site < 3; ++site) {
      for (std::size_t target = 0; target < 3; ++target) {
        // From here on all unknown samples are planned as if positive: this site to its end, then the next ones.
        std::vector<std::string> expected;
        for (std::size_t next = 3 * site + target; next < 9; ++next)
          expected.push_back("sample_" + std::to_string(next / 3) + "_" + std::to_string(next % 3));
        const auto [found, first] =
            plans.try_emplace(std::pair(known.to_ulong(), (positive & known).to_ulong()));
        if (first) found->second = plan(known, positive, 900);
        ASSERT_EQ(found->second, expected) << outcome;
        known.set(3 * site + target);
        if (!positive[3 * site + target]) break;
      }
    }
  }
}

TEST_F(SubwaySearch, WhenEnergyIsScarceTheMapIsCutAndNeverBroken) {
  EXPECT_THAT(plan(0, 0, 101), ElementsAre("sample_0_0", "sample_0_1"));
  EXPECT_THAT(plan(0, 0, 51), ElementsAre("sample_0_0"));
  EXPECT_THAT(plan(0, 0, 45), ElementsAre());  // a later site's sample would be paid for
}

}  // namespace
