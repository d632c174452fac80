#include "planner_svc/utility_htn/search/explanation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"
#include "tests/unit/planner_svc/utility_htn/search/toy.hpp"

namespace {

namespace search = roci::planner::utility_htn::search;
namespace model = roci::planner::utility_htn::model;
using roci::temporal::seconds;
using roci::temporal::timelines::Phase;
using search::Explanation, search::Outcome, search::Problem, search::Toy, search::WhyNot;

class WhyNotTest : public testing::Test {
 protected:
  Explanation ask(Problem problem, const std::string& chain, std::uint64_t entries = 10'000) {
    const Outcome outcome = search::search(problem, entries);
    const auto before = toy.timelines[0].kept();
    const Explanation out = search::why_not(problem, outcome, toy.chain(chain));
    EXPECT_EQ(toy.timelines[0].kept().tasks, before.tasks);
    return out;
  }
  Toy toy;
};

TEST_F(WhyNotTest, NamesTheTimeOfWhatIsPlannedAndTheOtherWay) {
  const model::TaskIndex raw = toy.task("raw", 10, 60, {0.6}, true, true);
  const model::TaskIndex compressed = toy.task("compressed", 10, 20, {0.4}, true, true);
  toy.parent("sample", {{raw}, {compressed}});
  toy.close();
  EXPECT_EQ(ask(toy.problem(100), "sample/a").text, "'sample/a' is planned from 0 s on");
  EXPECT_EQ(ask(toy.problem(100), "sample/b").text,
            "'sample/b' is not planned, since 'sample' is done as 'sample/a'");
  Problem problem = toy.problem(100);
  problem.closed = {toy.chains.chains[0].task};
  EXPECT_EQ(ask(problem, "sample/a").text,
            "'sample/a' is not planned, since nobody asks for 'sample' any more");
}

TEST_F(WhyNotTest, SaysWhatIsLeftOfTheBudget) {
  toy.task("cheap", 10, 60, {0.9});
  toy.task("dear", 10, 70, {0.5});
  toy.close();
  const Explanation found = ask(toy.problem(100), "dear");
  EXPECT_EQ(found.reason, WhyNot::too_dear);
  EXPECT_EQ(found.text,
            "'dear' is not planned, since it costs 70 of 'battery' and the plan leaves less than 40 of 100");
}

TEST_F(WhyNotTest, SaysWhichTaskHasNoTimeOrConflictsAndHow) {
  toy.task("short", 10, 1, {0.5});
  toy[0].closes = seconds(5);
  const model::TaskIndex needs = toy.task("needs", 10, 1, {0.5});
  toy[needs].constraints = {{Toy::kPhase, Phase::pre, -INFINITY, INFINITY, 2}};
  toy.close();
  const Explanation no_time = ask(toy.problem(100), "short");
  EXPECT_EQ(no_time.reason, WhyNot::out_of_window);
  EXPECT_EQ(
      no_time.text,
      "'short' is not planned, since 'short' could not start before 0 s and would have to start by -5 s");
  const Explanation conflict = ask(toy.problem(100), "needs");
  EXPECT_EQ(conflict.reason, WhyNot::no_valid_start);
  EXPECT_EQ(conflict.text,
            "'needs' is not planned, since 'needs' has no valid start from 0 s to 990 s: at 0 s 'phase' "
            "would be 'landed' "
            "at 0 s, which breaks a constraint of it");
}

TEST_F(WhyNotTest, NamesTheTargetToWhichTheMapLeads) {
  toy.network.subway.sites.push_back({"site", {0.5, {}, 1}, {}});
  for (const char* name : {"near", "far"}) {
    const model::TaskIndex sample = toy.task(name, 10, 60, {0, 0.5}, true);
    toy.network.subway.sites[0].targets.push_back(
        {sample, static_cast<std::uint32_t>(toy.network.timelines.size()), {0.5, {}, 1}});
    toy.network.timelines.push_back(
        {name, roci::temporal::timelines::Kind::state, {"unknown", "negative", "positive"}});
  }
  toy.close();
  const roci::planner::utility_htn::assessor::SubwayAssessor assessor(toy.network, toy.chains);
  Problem problem{toy.network, toy.values, toy.chains, assessor, toy.earliest, toy.timelines[0]};
  problem.until = seconds(1000);
  problem.budget = 50;  // pays none of the two
  problem.timelines_now = toy.now;
  const Explanation found = ask(problem, "far");
  EXPECT_EQ(found.reason, WhyNot::breaks_rule);
  EXPECT_EQ(found.text,
            "'far' is not planned, since the subway map does not lead to 'far': after what is planned it "
            "leads to 'near'");
}

TEST_F(WhyNotTest, TellsDataWithoutDownlinkWorthlessnessAndAnEarlyEnd) {
  toy.task("photo", 10, 1, {0.5});
  toy[0].products = {{"image", model::Tier::mandatory, {100, {}, 1}, {}}};
  toy.task("idle", 10, 1, {});
  toy.task("other", 10, 2, {0.5});
  toy.close();
  Problem problem = toy.problem(100);
  problem.downlink = [](const search::PlannedData& data) { return data.products.empty(); };
  EXPECT_EQ(ask(problem, "photo").reason, WhyNot::no_downlink);
  EXPECT_EQ(ask(toy.problem(100), "idle").text,
            "'idle' is not planned, since it would bring nothing and cost 1");
  const Explanation early = ask(toy.problem(100), "other", 1);
  EXPECT_EQ(early.reason, WhyNot::not_tried);
  EXPECT_EQ(
      early.text,
      "'other' would fit into the plan from 0 s on: the search ended after 1 entries, before it was tried");
  EXPECT_EQ(search::why_not(toy.problem(100), {}, toy.chain("other")).text,
            "'other' would fit into the plan from 0 s on: no search was made since it was taken out");
}

}  // namespace
