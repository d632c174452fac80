// Requests that nothing leads to any more: by hand, and on random networks against what can be placed.
#include "planner_svc/utility_htn/flattening/reach.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace roci::planner::utility_htn::flattening {
namespace {

using model::Network, model::TaskIndex;
using temporal::timelines::Kind;
using testing::ElementsAre, testing::IsEmpty;

// Digging opens a trench, finding asks for that and finds targets, sampling asks for both;
// the ground may set a flag for `asked`.
class Reach : public testing::Test {
 protected:
  Reach() {
    network.timelines = {{"trench", Kind::state, {"untouched", "open"}},
                         {"targets", Kind::state, {"unknown", "found"}},
                         {"flag", Kind::state, {"no", "yes"}}};
    primitive("dig", 0, 1, {{0, 1}});
    primitive("find", 1, 1, {{0, 2}});
    primitive("sample", 2, 0, {{0, 2}, {1, 2}});
    primitive("asked", 2, 0, {{2, 2}});
    network.tasks[dig].is_template = network.tasks[find].is_template = true;
    model::Task opening;
    opening.id = "open";
    opening.decompositions = {{"plain", {{.timeline = 0, .states = 1}}, {{dig}, {find}}}};
    network.tasks.push_back(opening);
  }

  // Assigns a timeline (2: none), and asks for states.
  void primitive(const std::string& id, temporal::timelines::Index sets, double to,
                 const std::vector<std::pair<temporal::timelines::Index, std::uint64_t>>& asks) {
    model::Task& task = network.tasks.emplace_back();
    task.id = id;
    if (sets < 2) task.impacts = {{sets, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {to}}};
    for (const auto& [timeline, states] : asks)
      task.constraints.push_back({.timeline = timeline, .states = states});
  }
  std::set<TaskIndex> lost(const std::set<TaskIndex>& open, std::vector<TaskIndex> under_way = {}) const {
    return out_of_reach(network, flatten(network), {}, {now, open, std::move(under_way)});
  }

  static constexpr TaskIndex dig = 0, find = 1, sample = 2, asked = 3, block = 4;
  Network network;
  std::vector<double> now{0, 0, 0};
};

TEST_F(Reach, WhatAnOpenRequestBringsAboutIsWithinReach) {
  EXPECT_THAT(lost({sample, block}), IsEmpty());
  EXPECT_THAT(lost({sample}), ElementsAre(sample)) << "nobody digs";
  EXPECT_THAT(lost({sample}, {dig, find}), IsEmpty()) << "it is being dug";
  now = {1, 1, 0};
  EXPECT_THAT(lost({sample}), IsEmpty()) << "it was dug";
}

TEST_F(Reach, WhatCannotBeginAgainBringsAboutNothing) {
  now = {1, 0, 0};  // dug, but nothing was found
  EXPECT_THAT(lost({sample, block}), ElementsAre(sample, block));
}

TEST_F(Reach, WhatNoTaskAssignsAnybodyMay) { EXPECT_THAT(lost({asked}), IsEmpty()); }

}  // namespace
}  // namespace roci::planner::utility_htn::flattening
