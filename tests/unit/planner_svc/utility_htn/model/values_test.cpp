// What timelines and budget see of a task (R67, R87).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner_svc/utility_htn/model/describe.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {
namespace {

using temporal::ImpactKind, temporal::ImpactWhen;
using temporal::timelines::Kind;

Network with_parameter() {
  Network out;
  out.parameters = {{"dig_s", 10, 1, 100, "chosen"}};
  out.timelines = {{"battery", Kind::cumulative_rate},
                   {"bytes", Kind::cumulative},
                   {"phase", Kind::state, {"a", "b", "c"}}};
  return out;
}

TEST(Values, AnAmountFollowsItsParameter) {
  const Values values{4};
  EXPECT_EQ(evaluate({3, {}, 7}, values), 3);
  EXPECT_EQ(evaluate({3, 0, -2}, values), -5);
}

TEST(Values, TheFootprintHasTheNewestValues) {
  Task task;
  task.duration = {1, 0, 2};
  task.impacts = {{0, ImpactKind::rate, ImpactWhen::during, {0, 0, -1}}};
  EXPECT_EQ(footprint(task, priors(with_parameter())).duration, temporal::seconds(21));
  const auto learnt = footprint(task, {20});
  EXPECT_EQ(learnt.duration, temporal::seconds(41));
  EXPECT_EQ(learnt.impacts.at(0).amount, -20);
}

// By hand: 20 s at 3 per second, and 5 at once; what is taken back, set, or of another timeline costs nothing.
TEST(Values, CostIsWhatIsTakenFromTheBudgetWhileTheTaskRuns) {
  Task task;
  task.duration = {0, 0, 2};
  task.impacts = {{0, ImpactKind::rate, ImpactWhen::during, {-3, {}, 1}},
                  {0, ImpactKind::delta, ImpactWhen::at_end, {-5, {}, 1}},
                  {0, ImpactKind::delta, ImpactWhen::during, {-9, {}, 1}},
                  {0, ImpactKind::assign, ImpactWhen::at_end, {1, {}, 1}},
                  {0, ImpactKind::rate, ImpactWhen::at_end, {-8, {}, 1}},
                  {1, ImpactKind::delta, ImpactWhen::at_end, {-7, {}, 1}}};
  EXPECT_EQ(cost(with_parameter(), task, priors(with_parameter())), 65);
}

TEST(Values, UtilityGoesByRank) {
  Task task;
  task.utility = {{0, {}, 1}, {0.5, 0, 0.01}};
  EXPECT_EQ(utility(task, {10}), temporal::RankVector({0, 0.6}));
}

TEST(Describing, ConstraintsAndAmountsReadAsInTheFile) {
  const Network network = with_parameter();
  EXPECT_EQ(to_text(Amount{-5, 0, -1}, network), "-dig_s - 5");
  EXPECT_EQ(to_text(Amount{0.1, 0, 2.5}, network), "2.5 * dig_s + 0.1");
  using temporal::timelines::Phase;
  EXPECT_EQ(to_text({2, Phase::pre, -INFINITY, INFINITY, 2}, network), "phase = b");
  EXPECT_EQ(to_text({2, Phase::pre, -INFINITY, INFINITY, 5}, network), "phase in a, c");
  EXPECT_EQ(to_text({0, Phase::pre, 5}, network), "battery >= 5");
  EXPECT_EQ(to_text({0, Phase::pre, 5, 7}, network), "battery in 5 .. 7");
}

}  // namespace
}  // namespace roci::planner::utility_htn::model
