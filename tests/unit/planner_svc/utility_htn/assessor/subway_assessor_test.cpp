#include "planner_svc/utility_htn/assessor/subway_assessor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

namespace assessor = roci::planner::utility_htn::assessor;
namespace flattening = roci::planner::utility_htn::flattening;
namespace model = roci::planner::utility_htn::model;
using assessor::Context, assessor::ExistingProduct, assessor::SubwayAssessor;
using roci::temporal::RankVector;
using testing::DoubleEq, testing::ElementsAre, testing::HasSubstr, testing::IsEmpty;

// Two sites of two targets. Ranks: mission, analysis, excavation. A first sample digs, a next one does not.
class SubwayAssessorTest : public testing::Test {
 protected:
  SubwayAssessorTest() {
    network.ranks = {"mission", "analysis", "excavation"};
    network.batches = {"sampling"};
    const model::TaskIndex transport = primitive("transport", {});
    const model::TaskIndex send = primitive("send", {0, 0.5});
    network.tasks[send].downlinks = true;
    for (const std::string site : {"0", "1"}) {
      const model::TaskIndex dig = primitive("dig_" + site, {0, 0, 0.25});
      model::Site& of = network.subway.sites.emplace_back();
      of.name = "site_" + site;
      of.value.constant = site == "0" ? 0.8 : 0.4;
      for (const std::string target : {"0", "1"}) {
        const model::TaskIndex collect = primitive("collect_" + site + "_" + target, {0, 1});
        model::Task sample;
        sample.id = "sample_" + site + "_" + target;
        sample.decompositions = {{"first", {}, {{dig}, {collect}, {transport}, {send}}},
                                 {"next", {}, {{collect}, {transport}, {send}}}};
        of.targets.push_back({static_cast<model::TaskIndex>(network.tasks.size()),
                              static_cast<std::uint32_t>(network.timelines.size()),
                              {target == "0" ? 1.0 : 0.5, {}, 1}});
        network.tasks.push_back(sample);
        network.timelines.push_back({"signature_" + site + "_" + target,
                                     roci::temporal::timelines::Kind::state,
                                     {"unknown", "negative", "positive"}});
      }
    }
    primitive("panorama", {0, 0, 0, 0.1}, false);
    chains = flattening::flatten(network);
    now.resize(network.timelines.size());
  }

  model::TaskIndex primitive(const std::string& id, std::vector<double> scores, bool is_template = true) {
    model::Task& task = network.tasks.emplace_back();
    task.id = id;
    task.is_template = is_template;
    for (const double score : scores) task.utility.push_back({score, {}, 1});
    return static_cast<model::TaskIndex>(network.tasks.size() - 1);
  }
  std::uint32_t chain(const std::string& name) const {
    for (std::uint32_t index = 0; index < chains.chains.size(); ++index) {
      if (chains.chains[index].name == name) return index;
    }
    throw std::invalid_argument(name);
  }
  model::TaskIndex task(const std::string& id) const {
    for (model::TaskIndex index = 0; index < network.tasks.size(); ++index) {
      if (network.tasks[index].id == id) return index;
    }
    throw std::invalid_argument(id);
  }
  Context context(const std::vector<std::uint32_t>& planned) const {
    return {network, values, chains, now, products, planned, closed};
  }
  RankVector predicted(const std::string& name, const std::vector<std::uint32_t>& planned = {}) const {
    return SubwayAssessor(network, chains).predicted(chain(name), context(planned));
  }

  model::Network network;
  model::Values values;
  flattening::Chains chains;
  std::vector<double> now;
  std::vector<ExistingProduct> products;
  std::vector<model::TaskIndex> closed;
};

TEST_F(SubwayAssessorTest, TheMissionRankHoldsWhereTheMapLeads) {
  EXPECT_EQ(predicted("sample_0_0/first")[0], 1);
  EXPECT_EQ(predicted("sample_0_1/first")[0], -1);
  EXPECT_EQ(predicted("sample_1_0/first")[0], -1);
  const std::vector<std::uint32_t> planned{chain("sample_0_0/first")};
  EXPECT_EQ(predicted("sample_0_1/next", planned)[0], 1);
  EXPECT_EQ(predicted("sample_1_0/first", planned)[0], -1);
  now[network.subway.sites[0].targets[0].signature] = 1;
  EXPECT_EQ(predicted("sample_0_1/next")[0], -1);
  EXPECT_EQ(predicted("sample_1_0/first")[0], 1);
}

TEST_F(SubwayAssessorTest, SamplingIsWeightedAndCommunicationIsConstant) {
  EXPECT_THAT(predicted("sample_0_0/first").scores(), ElementsAre(1, DoubleEq(0.8 * 1.0 + 0.5), 0.25));
  const RankVector second = predicted("sample_0_1/next", {chain("sample_0_0/first")});
  EXPECT_DOUBLE_EQ(second[1], 0.8 * 0.5 + 0.5);
  EXPECT_EQ(predicted("panorama"), (RankVector{0, 0, 0, 0.1}));
}

TEST_F(SubwayAssessorTest, AnExcavatedSiteScoresWhatItIsAndTargetsWhatIsPredicted) {
  EXPECT_EQ(predicted("sample_0_0/next")[2], 0);  // nothing is dug, nothing is planned to be
  EXPECT_EQ(predicted("sample_0_1/next", {chain("sample_0_0/first")})[2], 0.25);
  products.push_back({"image", task("dig_0"), task("sample_0_0"), {0, 0, 0.75}});
  EXPECT_THAT(predicted("sample_0_0/next").scores(), ElementsAre(1, DoubleEq(0.8 + 0.5), 0.75));
  EXPECT_EQ(predicted("sample_0_1/next", {chain("sample_0_0/first")})[2], 0.75);
  EXPECT_EQ(predicted("sample_1_0/next")[2], 0);
}

TEST_F(SubwayAssessorTest, PredictedAndExecutedUtilityAreTwoThings) {
  const ExistingProduct measured{"analysis", task("collect_0_0"), task("sample_0_0"), {0, 0.125}};
  const RankVector before = predicted("sample_0_0/first");
  products.push_back(measured);
  EXPECT_EQ(predicted("sample_0_0/first"), before);
  EXPECT_EQ(SubwayAssessor(network, chains).executed(measured, context({})), (RankVector{0, 0.125}));
}

TEST_F(SubwayAssessorTest, NoContextIsWorthMoreThanTheMost) {
  const SubwayAssessor assessor(network, chains);
  products.push_back({"image", task("dig_1"), task("sample_1_0"), {0, 0, 0.75}});
  for (const double signature : {0.0, 1.0, 2.0}) {
    now[0] = signature;
    for (std::uint32_t each = 0; each < chains.chains.size(); ++each) {
      const RankVector most = assessor.most(each, context({}));
      for (std::uint32_t other = 0; other < chains.chains.size(); ++other) {
        const std::vector<std::uint32_t> planned{other};
        const RankVector utility = assessor.predicted(each, context(planned));
        for (std::size_t rank = 0; rank < 4; ++rank)
          EXPECT_GE(most[rank], utility[rank]) << each << " " << other;
      }
    }
  }
}

TEST_F(SubwayAssessorTest, AnObjectionNamesTheTargetToWhichTheMapLeads) {
  const SubwayAssessor assessor(network, chains);
  EXPECT_THAT(assessor.objection(chain("sample_0_0/first"), context({})), IsEmpty());
  EXPECT_THAT(assessor.objection(chain("panorama"), context({})), IsEmpty());
  EXPECT_EQ(assessor.objection(chain("sample_1_0/first"), context({})),
            "the subway map does not lead to 'sample_1_0': after what is planned it leads to 'sample_0_0'");
  closed = {task("sample_0_0"), task("sample_0_1"), task("sample_1_0"), task("sample_1_1")};
  EXPECT_THAT(assessor.objection(chain("sample_1_0/first"), context({})),
              HasSubstr("every site is finished"));
}

// Each site is opened by a task of its own, as in RSM-1.
TEST_F(SubwayAssessorTest, ASiteIsOpenedWhenTheMapLeadsToIt) {
  for (const std::uint32_t site : {0U, 1U}) {
    const auto opened = static_cast<std::uint32_t>(network.timelines.size());
    network.timelines.push_back(
        {"opened_" + std::to_string(site), roci::temporal::timelines::Kind::state, {"no", "yes"}});
    for (const model::Target& target : network.subway.sites[site].targets)
      network.tasks[target.task].decompositions[1].when = {
          {opened, roci::temporal::timelines::Phase::pre, -INFINITY, INFINITY, 2}};
    const model::TaskIndex open = primitive("open_" + std::to_string(site), {0, 0, 0.125}, false);
    network.tasks[open].impacts = {
        {opened, roci::temporal::ImpactKind::assign, roci::temporal::ImpactWhen::at_end, {1, {}, 1}}};
  }
  chains = flattening::flatten(network);
  now.resize(network.timelines.size());
  EXPECT_EQ(predicted("open_0"), (RankVector{0, 0, 0.125}));
  EXPECT_EQ(predicted("open_1")[0], -1);
  const std::vector<std::uint32_t> site_0{chain("open_0"), chain("sample_0_0/next"),
                                          chain("sample_0_1/next")};
  EXPECT_EQ(predicted("open_1", site_0), (RankVector{0, 0, 0.125}));
  EXPECT_EQ(predicted("sample_0_0/next", {chain("open_0")})[2], 0.125);  // planned support
  products.push_back({"image", task("open_0"), task("open_0"), {0, 0, 0.75}});
  EXPECT_EQ(predicted("sample_0_0/next")[2], 0.75);
  EXPECT_THAT(SubwayAssessor(network, chains).objection(chain("open_1"), context({})),
              HasSubstr("does not lead to 'open_1': after what is planned it leads to 'sample_0_0'"));
}

TEST_F(SubwayAssessorTest, AForecastSaysWhatIsPredicted) {
  std::mt19937 random(7);
  const auto any = [&](std::size_t count) { return static_cast<std::uint32_t>(random() % count); };
  for (int world = 0; world < 300; ++world) {
    for (double& signature : now) signature = random() % 3 == 0 ? random() % 3 : 0;
    network.subway.rank = any(2);
    closed.clear();
    if (any(2) == 0)
      closed.push_back(task("sample_" + std::to_string(any(2)) + "_" + std::to_string(any(2))));
    products.clear();
    if (any(2) == 0) products.push_back({"image", task("dig_0"), task("sample_0_0"), {0, 0, 0.75}});
    const SubwayAssessor assessor(network, chains);
    const auto forecast = assessor.forecast(context({}));
    std::vector<std::uint32_t> planned;
    for (int length = 0; length < 5; ++length) {
      for (std::uint32_t each = 0; each < chains.chains.size(); ++each) {
        const RankVector predicted = assessor.predicted(each, context(planned));
        const RankVector forecasted = forecast->predicted(each);
        if (predicted < RankVector{}) {
          EXPECT_LT(forecasted, RankVector{}) << chains.chains[each].name;
        } else {
          EXPECT_EQ(forecasted, predicted) << chains.chains[each].name;
        }
      }
      planned.push_back(any(chains.chains.size()));
      length % 2 == 0 ? forecast->plan_next(planned.back()) : forecast->plan(planned);
    }
  }
}

}  // namespace
