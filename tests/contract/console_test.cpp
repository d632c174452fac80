// The ground's client against a flying executive, on every transport: a console that joins late sees the
// state of the mission; goals go up and their answers come down.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "ground_console/lib/client.hpp"
#include "services/process/domain_claim.hpp"
#include "tests/unit/exec_svc/service/exec_seat.hpp"

namespace roci::console::lib {
namespace {

using namespace std::chrono_literals;
using exec::testing::ExecSeat;
using exec::testing::photo_goal;
using testing::HasSubstr;

struct Vendors {
  const char* name;
  std::string console;
  std::string executive;
};

class ConsoleTest : public testing::TestWithParam<Vendors> {
 protected:
  services::process::Connection connection() const {
    services::process::Connection out;
    out.dds = GetParam().console;
    out.transport.domain = domain_.id();
    out.transport.participant = "console";
    return out;
  }

  static constexpr std::chrono::seconds kLimit{30};

  services::process::DomainClaim domain_;
  ExecSeat seat_{GetParam().executive, GetParam().executive, domain_.id()};
};

TEST_P(ConsoleTest, ALateOneSeesTheStateOfTheMission) {
  seat_.send(10s, photo_goal("ridge"));
  seat_.run().start();
  {
    Client first(connection());  // until the mission is over and stands still
    ASSERT_TRUE(first.wait(
        [&] { return first.view().mission() && !first.view().mission()->outcome().empty(); }, kLimit));
  }
  // State comes in its own time: what a run keeps of each key may pass by before the newest.
  Client late(connection());
  const MissionView& view = late.view();
  EXPECT_TRUE(late.wait([&] { return view.mission() && view.mission()->outcome() == "achieved"; }, kLimit));
  EXPECT_TRUE(late.wait(
      [&] {
        const auto goal = view.goals().find({"ground", "ridge"});
        return goal != view.goals().end() && goal->second.goal_state() == v1::GOAL_ACHIEVED;
      },
      kLimit));
  EXPECT_TRUE(late.wait(
      [&] {
        const v1::StepStatus* step = view.step("p1.1-take-image");
        return view.plan() && view.plan()->version() == 1 && step != nullptr &&
               step->state() == v1::ACTIVITY_SUCCEEDED;
      },
      kLimit));
  EXPECT_TRUE(late.wait(
      [&] {
        const v1::TimelineValue* image = view.timeline("rover.image.image-ridge");
        return image != nullptr && value_text(*image) == "sent";
      },
      kLimit));
  EXPECT_TRUE(late.wait([&] { return view.services().size() == 3; }, kLimit));
  seat_.robot().stop();
}

TEST_P(ConsoleTest, GoalsGoUpAndAnswersComeDown) {
  seat_.run().start();
  Client client(connection());
  const auto added = client.send_goal(photo_goal("more"), kLimit);
  ASSERT_TRUE(added);
  EXPECT_NE(added->goal_state(), v1::GOAL_REJECTED) << added->reason();
  v1::Goal bad = photo_goal("bad");
  bad.arguments()[0].value("far");
  const auto refused = client.send_goal(bad, kLimit);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->goal_state(), v1::GOAL_REJECTED);
  EXPECT_THAT(refused->reason(), HasSubstr("expected a number"));
  EXPECT_TRUE(client.wait(
      [&] { return client.view().mission() && client.view().mission()->outcome() == "achieved"; }, kLimit));
  v1::Goal recall = photo_goal("more");
  recall.recalled(true);
  const auto recalled = client.send_goal(recall, kLimit);
  ASSERT_TRUE(recalled);
  EXPECT_EQ(recalled->goal_state(), v1::GOAL_ACHIEVED) << "too late";
  seat_.robot().stop();
}

// The answer to a change is not the state from before it, however late the console joined.
TEST_P(ConsoleTest, AChangedGoalIsAnsweredForTheChange) {
  seat_.send(10s, photo_goal("ridge"));
  seat_.run().start();
  {
    Client first(connection());
    ASSERT_TRUE(first.wait(
        [&] { return first.view().mission() && first.view().mission()->outcome() == "achieved"; }, kLimit));
  }
  Client late(connection());
  ASSERT_TRUE(late.wait(
      [&] {
        const auto ridge = late.view().goals().find({"ground", "ridge"});
        return ridge != late.view().goals().end() && ridge->second.goal_state() == v1::GOAL_ACHIEVED;
      },
      kLimit));
  v1::Goal changed = photo_goal("ridge");
  changed.arguments()[0].value("far");
  const auto refused = late.send_goal(changed, kLimit);
  ASSERT_TRUE(refused);
  EXPECT_THAT(refused->reason(), HasSubstr("change refused"));
  const auto again = late.send_goal(changed, kLimit);  // in the same words
  ASSERT_TRUE(again);
  EXPECT_EQ(again->answers().seq(), refused->answers().seq() + 1);
  EXPECT_EQ(again->reason(), refused->reason());
  seat_.robot().stop();
}

// Also when it has not heard yet what the goal's state was before the change. (The state may have moved on
// since.)
TEST_P(ConsoleTest, AnAnswerNamesTheSampleThatItAnswers) {
  seat_.run().start();
  std::set<std::string> senders;
  for (const char* x : {"50", "far", "60", "near", "70"}) {
    Client client(connection());
    v1::Goal goal = photo_goal("more");
    goal.arguments()[0].value(x);
    const auto status = client.send_goal(goal, kLimit);
    ASSERT_TRUE(status);
    EXPECT_TRUE(senders.insert(status->answers().sender()).second) << x;
    EXPECT_EQ(status->answers().seq(), 1U);
  }
  seat_.robot().stop();
}

TEST_P(ConsoleTest, AnOrdersStagesComeDownAsTheyAreReached) {
  seat_.run().start();
  Client client(connection());
  std::vector<v1::OrderStage> stages;
  const auto give = [&](const std::string& id, v1::OrderKind kind, const std::string& target) {
    v1::Order order;
    order.issuer("ground");
    order.id(id);
    order.order_kind(kind);
    order.target(target);
    order.autonomy(v1::AUTONOMY_E4);
    stages.clear();
    return client.send_order(
        order, [&](const v1::OrderStatus& status) { stages.push_back(status.stage()); }, kLimit);
  };
  ASSERT_TRUE(give("1", v1::ORDER_HOLD, ""));
  // The topic keeps the newest stage: who is slow hears fewer of them, in their order, and always the last.
  EXPECT_TRUE(std::ranges::is_sorted(stages));
  EXPECT_EQ(stages.back(), v1::ORDER_APPLIED);
  EXPECT_TRUE(client.wait([&] { return client.view().mission() && client.view().mission()->held(); }, kLimit));
  const auto refused = give("2", v1::ORDER_HOLD, "nothing");
  ASSERT_TRUE(refused);
  EXPECT_EQ(stages.back(), v1::ORDER_REFUSED);
  EXPECT_EQ(refused->reason(), "no plan runs");
  ASSERT_TRUE(give("1", v1::ORDER_HOLD, ""));
  EXPECT_THAT(stages, testing::ElementsAre(v1::ORDER_APPLIED)) << "it was given before";
  ASSERT_TRUE(give("3", v1::ORDER_RELEASE, ""));
  EXPECT_TRUE(client.wait([&] { return !client.view().mission()->held(); }, kLimit));
  seat_.robot().stop();
}

TEST_P(ConsoleTest, NobodyAnswers) {
  Client client(connection());
  EXPECT_FALSE(client.wait_for_mission(0ms));
  EXPECT_FALSE(client.send_goal(photo_goal("alone"), 0ms));
}

INSTANTIATE_TEST_SUITE_P(Transports, ConsoleTest,
                         testing::Values(Vendors{"inproc", "inproc", "inproc"},
                                         Vendors{"fastdds", "fastdds", "fastdds"},
                                         Vendors{"cyclonedds", "cyclonedds", "cyclonedds"},
                                         Vendors{"mixed", "cyclonedds", "fastdds"}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace roci::console::lib
