// What was reported last of a state, and what is expected of it though nobody has reported it yet.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/checking/utility_checker.hpp"
#include "tests/unit/planner_svc/utility_htn/checking/told_plan.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using namespace std::chrono_literals;
using temporal::ActivityState, temporal::CommitState, temporal::FlexiblePlan, temporal::Time;
using ::testing::Contains, ::testing::HasSubstr, ::testing::IsEmpty;

constexpr Time kNow = 160s;

/// Digging needs `health`; `mend` brings that about when it ends, and `sky` as long as it lasts,
/// with a command or by itself.
model::Network network() {
  model::Network out = testing::toy_network();
  model::Task sky;
  sky.id = sky.name = "sky";
  sky.fixed = true;
  sky.preferred_start = 90s;
  sky.duration = {400};
  sky.impacts = {{testing::kHealth, temporal::ImpactKind::assign, temporal::ImpactWhen::at_start, {0}},
                 {testing::kHealth, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {1}}};
  out.tasks.push_back(sky);
  model::Task mend;
  mend.id = mend.name = "mend";
  mend.duration = {50};
  mend.commands = {{}};
  mend.impacts = {{testing::kHealth, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {0}}};
  out.tasks.push_back(mend);
  return out;
}

/// Of a plan that digs at 200 s, where `health` is reported as broken, and `task` stands in the plan from 90 s on.
std::vector<std::string> faults_beside(const std::string& task, Time length,
                                       temporal::ActivityProgress went) {
  FlexiblePlan plan;
  plan.version = 2;
  plan.point_count = 2;
  add(plan, "dig", 1, 0, 200s, 100s, CommitState::planned);
  add(plan, "image", 1, 1, 300s, 50s, CommitState::planned);
  add(plan, "send_sample", 1, 2, 350s, 20s, CommitState::planned);
  plan.tokens.push_back({"sample", temporal::state("sample/plain", {"1"}), 2, plan.point_count - 1});
  add(plan, task, 2, 0, 90s, length, CommitState::committed);
  plan.tokens.push_back({task, temporal::state(task, {"2"}), plan.point_count - 2, plan.point_count - 1});
  const temporal::Progress progress{{task + "#2.0", went}};
  engine::Request situation;
  situation.origin = kNow;
  situation.state = {{"battery", temporal::Value{900.0}}, {"health", temporal::state("broken")}};
  return faults_of(network(), {situation, {}, plan, nullptr, &progress});
}

const auto kBroken = HasSubstr("its precondition on 'health' is broken");

TEST(ExpectedReports, AViewThatHasBegunByTheNetworkIsExpectedThoughItIsLate) {
  EXPECT_THAT(faults_beside("sky", 400s, {ActivityState::running, 90s, {}}), IsEmpty());
  EXPECT_THAT(faults_beside("sky", 60s, {ActivityState::succeeded, 90s, 150s}), Contains(kBroken))
      << "it is over";
}

TEST(ExpectedReports, WhatACommandHasBroughtAboutIsExpectedForAnInterval) {
  EXPECT_THAT(faults_beside("mend", 62s, {ActivityState::succeeded, 90s, 152s}), IsEmpty());
  EXPECT_THAT(faults_beside("mend", 50s, {ActivityState::succeeded, 90s, 140s}), Contains(kBroken))
      << "it has not come about";
  EXPECT_THAT(faults_beside("mend", 62s, {ActivityState::failed, 90s, 152s}), Contains(kBroken));
}

}  // namespace
}  // namespace roci::planner::utility_htn::checking
