// From parents to chains of primitive tasks (MEXEC, section III.A, R87, R92).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/flattening/chain.hpp"
#include "planner_svc/utility_htn/model/check.hpp"
#include "tests/unit/planner_svc/utility_htn/random/random_network.hpp"

namespace roci::planner::utility_htn::flattening {
namespace {

using model::Network, model::Subtask, model::Task, model::TaskIndex;
using temporal::seconds;
using testing::ElementsAre;

Task primitive(const std::string& id, double duration, double utility) {
  Task out;
  out.id = id;
  out.is_template = true;
  out.duration.constant = duration;
  out.utility = {{utility, {}, 1}};
  out.impacts = {{0, temporal::ImpactKind::rate, temporal::ImpactWhen::during, {-2, {}, 1}}};
  return out;
}

// sample = dig? then send; send = raw or compressed.
Network two_levels() {
  Network out;
  out.ranks = {"science"};
  out.timelines = {{"battery", temporal::timelines::Kind::cumulative_rate, {}, 100, 0, 100}};
  out.tasks = {primitive("dig", 10, 0),
               primitive("take", 5, 0.25),
               primitive("raw", 4, 0.5),
               primitive("compressed", 1, 0.125),
               {},
               {}};
  Task& send = out.tasks[4];
  send.id = "send";
  send.is_template = true;
  send.decompositions = {{"raw", {}, {{2, {}, temporal::no_bound}}},
                         {"compressed", {}, {{3, {}, temporal::no_bound}}}};
  Task& sample = out.tasks[5];
  sample.id = "sample";
  const temporal::timelines::Constraint open{0, temporal::timelines::Phase::pre, 50};
  sample.decompositions = {{"first", {open}, {{0}, {1, seconds(1), seconds(2)}, {4, seconds(3), seconds(9)}}},
                           {"next", {}, {{1}, {4}}}};
  return out;
}

std::vector<std::string> names(const Chains& chains) {
  std::vector<std::string> out;
  for (const Chain& chain : chains.chains) out.push_back(chain.name);
  return out;
}

TEST(Flattening, EveryChoiceIsAChainInTheOrderOfTheNetwork) {
  const Chains chains = flatten(two_levels());
  EXPECT_THAT(names(chains), ElementsAre("sample/first/raw", "sample/first/compressed", "sample/next/raw",
                                         "sample/next/compressed"));
  EXPECT_THAT(chains.by_batch, ElementsAre(ElementsAre(0, 1, 2, 3)));
}

TEST(Flattening, ASubtasksGapIsThatBeforeItsFirstLinkAndConditionsAddUp) {
  const Chain chain = flatten(two_levels()).chains.at(1);
  EXPECT_THAT(chain.links, ElementsAre(Subtask{0}, Subtask{1, seconds(1), seconds(2)},
                                       Subtask{3, seconds(3), seconds(9)}));
  ASSERT_EQ(chain.when.size(), 1U);
  EXPECT_EQ(chain.when[0].lowest, 50);
}

TEST(Flattening, UtilityAndCostAreSumsOverTheLinks) {
  const Network network = two_levels();
  const model::Values values = model::priors(network);
  const Chain chain = flatten(network).chains.at(0);
  EXPECT_EQ(cost(network, chain, values), 2 * (10 + 5 + 4));
  EXPECT_EQ(utility(network, chain, values), temporal::RankVector({0.75}));
}

TEST(Flattening, WhatIsRequestedAndPrimitiveIsAChainOfOneAndTemplatesAreNone) {
  Network network = two_levels();
  network.tasks[5].is_template = true;
  network.tasks[0].is_template = false;
  EXPECT_THAT(names(flatten(network)), ElementsAre("dig"));
}

TEST(Flattening, BatchesListTheirOwnChains) {
  Network network = two_levels();
  network.batches = {"early", "late"};
  network.tasks[0].is_template = false;
  network.tasks[0].batch = 1;
  EXPECT_THAT(flatten(network).by_batch, ElementsAre(ElementsAre(1, 2, 3, 4), ElementsAre(0)));
}

TEST(Flattening, TooManyChainsAreRefusedBeforeTheyAreMade) {
  Network network = two_levels();
  network.tasks[5].decompositions.resize(1);
  network.tasks[5].decompositions[0].subtasks.assign(17, Subtask{4});  // 2^17
  try {
    flatten(network);
    FAIL() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("task 'sample' has more than 100000 chains"));
  }
}

// The same by plain recursion: each list of primitive tasks that a task may become.
std::vector<std::vector<TaskIndex>> ways(const Network& network, TaskIndex index) {
  const Task& task = network.tasks[index];
  if (task.primitive()) return {{index}};
  std::vector<std::vector<TaskIndex>> out;
  for (const auto& decomposition : task.decompositions) {
    std::vector<std::vector<TaskIndex>> begun{{}};
    for (const Subtask& subtask : decomposition.subtasks) {
      std::vector<std::vector<TaskIndex>> longer;
      for (const auto& head : begun)
        for (const auto& tail : ways(network, subtask.task)) {
          longer.push_back(head);
          longer.back().insert(longer.back().end(), tail.begin(), tail.end());
        }
      begun = longer;
    }
    out.insert(out.end(), begun.begin(), begun.end());
  }
  return out;
}

TEST(Flattening, AgreesWithANaiveEnumerationOfRandomNetworks) {
  std::mt19937_64 random(7);
  std::size_t chains = 0;
  for (int round = 0; round < 300; ++round) {
    const Network network = random_network(random);
    ASSERT_TRUE(model::usable(model::check(network)));
    std::vector<std::vector<TaskIndex>> expected;
    for (TaskIndex index = 0; index < network.tasks.size(); ++index) {
      if (network.tasks[index].is_template) continue;
      const auto those = ways(network, index);
      expected.insert(expected.end(), those.begin(), those.end());
    }
    std::vector<std::vector<TaskIndex>> found;
    for (const Chain& chain : flatten(network).chains) {
      found.emplace_back();
      for (const Subtask& link : chain.links) found.back().push_back(link.task);
    }
    ASSERT_EQ(found, expected) << "round " << round;
    chains += found.size();
  }
  EXPECT_GT(chains, 1000U);
}

}  // namespace
}  // namespace roci::planner::utility_htn::flattening
