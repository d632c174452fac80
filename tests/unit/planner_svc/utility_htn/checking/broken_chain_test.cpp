// What the checker asks of a chain of which a link has failed: nothing of it need stand in the next version.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/checking/utility_checker.hpp"
#include "tests/unit/planner_svc/utility_htn/checking/told_plan.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using namespace std::chrono_literals;
using temporal::ActivityState, temporal::CommitState, temporal::FlexiblePlan;
using ::testing::HasSubstr, ::testing::IsEmpty;

FlexiblePlan with_sample() {
  FlexiblePlan out;
  out.version = 1;
  out.point_count = 2;
  add(out, "dig", 1, 0, 100s, 100s, CommitState::committed);
  add(out, "image", 1, 1, 200s, 50s, CommitState::committed);
  add(out, "send_sample", 1, 2, 250s, 20s, CommitState::planned);
  out.tokens.push_back({"sample", temporal::state("sample/plain", {"1"}), 2, out.point_count - 1});
  return out;
}

std::vector<std::string> faults_after(const temporal::Progress& progress) {
  const model::Network network = testing::toy_network();
  const FlexiblePlan before = with_sample();
  FlexiblePlan next;
  next.version = 2;
  next.point_count = 2;
  engine::Request situation;
  situation.origin = 160s;
  situation.state["battery"] = temporal::Value{900.0};
  return faults_of(network, {situation, {}, next, &before, &progress});
}

TEST(BrokenChain, WhatIsSkippedBehindAFailureNeedNotStandInTheNextVersion) {
  EXPECT_THAT(faults_after({{"dig#1.0", {ActivityState::failed, 100s, 160s}},
                            {"image#1.1", {ActivityState::skipped, {}, 160s}}}),
              IsEmpty());
  EXPECT_THAT(faults_after({{"dig#1.0", {ActivityState::failed, 100s, 160s}}}), IsEmpty())
      << "not skipped yet, and it never starts";
}

TEST(BrokenChain, WhatRunsStands) {
  EXPECT_THAT(faults_after({{"dig#1.0", {ActivityState::running, 100s, {}}}}),
              ::testing::Contains(HasSubstr("is missing from the new version")));
}

}  // namespace
}  // namespace roci::planner::utility_htn::checking
