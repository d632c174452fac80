// What was sent counts for the limit of its sol, also when its chain has left the plan (R111).
#include "planner_svc/utility_htn/checking/sent_downlinks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner_svc/utility_htn/checking/utility_checker.hpp"
#include "tests/unit/planner_svc/utility_htn/checking/told_plan.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::checking {
namespace {

using namespace std::chrono_literals;
using temporal::ActivityState, temporal::CommitState, temporal::FlexiblePlan, temporal::Time;
using ::testing::Contains, ::testing::HasSubstr, ::testing::Not;

// Each downlink takes 20 s at 5 W, and a sol has energy for one and a half.
model::Network with_limit() {
  model::Network out = testing::toy_network();
  for (const char* id : {"send_sample", "send_view"})
    out.tasks[testing::task_named(out, id)].downlinks = true;
  out.parameters.push_back({"rate_bytes_per_s", 10, 0, 1e9});
  out.parameters.push_back({"sol_limit_j", 150, 0, 1e9});
  return out;
}

FlexiblePlan nothing_planned(std::uint32_t version) {
  FlexiblePlan out;
  out.version = version;
  out.point_count = 2;
  return out;
}

class SentDownlinksTest : public ::testing::Test {
 protected:
  std::vector<std::string> faults(const FlexiblePlan& plan, const FlexiblePlan& before,
                                  const temporal::Progress& progress, Time now = 160s) {
    engine::Request situation;
    situation.origin = now;
    situation.state["battery"] = temporal::Value{900.0};
    const engine::CheckedPlan checked{situation, {}, plan, &before, &progress};
    sent_.take(network_, checked);
    return faults_of(network_, checked, sent_.steps(network_));
  }

  model::Network network_ = with_limit();
  SentDownlinks sent_;
};

TEST_F(SentDownlinksTest, CountForTheirSolWhenTheirChainHasLeftThePlan) {
  FlexiblePlan first = nothing_planned(1);
  add(first, "image", 1, 0, 50s, 50s, CommitState::committed);
  add(first, "send_view", 1, 1, 100s, 20s, CommitState::committed);
  first.tokens.push_back({"view", temporal::state("view/plain", {"1"}), 2, first.point_count - 1});
  FlexiblePlan second = nothing_planned(2);
  FlexiblePlan third = nothing_planned(3);
  add(third, "dig", 2, 0, 200s, 100s, CommitState::planned);
  add(third, "image", 2, 1, 300s, 50s, CommitState::planned);
  add(third, "send_sample", 2, 2, 350s, 20s, CommitState::planned);
  third.tokens.push_back({"sample", temporal::state("sample/plain", {"2"}), 2, third.point_count - 1});

  const auto of_limit = HasSubstr("take 200 J of the 150 J that they may");
  EXPECT_THAT(faults(third, second, {}), Not(Contains(of_limit)));
  EXPECT_THAT(faults(second, first,
                     {{"image#1.0", {ActivityState::succeeded, 50s, 100s}},
                      {"send_view#1.1", {ActivityState::succeeded, 100s, 120s}}}),
              Not(Contains(HasSubstr("that they may"))));
  EXPECT_THAT(faults(third, second, {}), Contains(of_limit));
  network_.tasks.insert(network_.tasks.begin(), network_.tasks.front());
  network_.tasks.front().id = "of a network that replaces it";
  EXPECT_EQ(network_.tasks[sent_.steps(network_).front().task].id, "send_view");
}

// A sol of this network lasts 200 s, and could be measured as one of 300 s.
TEST_F(SentDownlinksTest, AreForgottenWhenTheLongestSolSinceTheirStartIsOver) {
  network_.parameters.push_back({"sol_s", 200, 1, 300});
  FlexiblePlan first = nothing_planned(1);
  add(first, "image", 1, 0, 50s, 50s, CommitState::committed);
  add(first, "send_view", 1, 1, 100s, 20s, CommitState::committed);
  const FlexiblePlan second = nothing_planned(2);
  const temporal::Progress progress{{"image#1.0", {ActivityState::succeeded, 50s, 100s}},
                                    {"send_view#1.1", {ActivityState::succeeded, 100s, 120s}}};
  faults(second, first, progress);
  faults(second, second, {}, 399s);
  EXPECT_EQ(sent_.steps(network_).size(), 1U);
  faults(second, second, {}, 400s);
  EXPECT_TRUE(sent_.steps(network_).empty());
}

}  // namespace
}  // namespace roci::planner::utility_htn::checking
