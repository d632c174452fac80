#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "exec_svc/reactor/message_fields.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"

namespace roci::exec {

using archive::ArchiveError;
using archive::from_bytes;
using archive::to_bytes;
using executive::CommandStage;
using goals::GoalClass;
using goals::GoalRequest;
using reactor::PlanReply;
using reactor::ReactorInputs;
using temporal::Verdict;

namespace {

using temporal::Time;

ReactorInputs rich_inputs() {
  ReactorInputs in;
  in.restarted = true;
  in.goals = {testing::photo("a\xff\0b", GoalClass::optional, 0.1)};
  in.goals[0].opens = Time(-5);
  in.goals[0].closes = Time::max();
  in.observations = {{"x", 0.1 + 0.2}, {"t", true}, {"s", temporal::state("at", {"p", ""})}, {"n", {}}};
  in.acks = {{"p1.1-go", 4'000'000'000U, CommandStage::cancel_failed, "code", "why"}};
  in.losses = {{"sim_svc", "killed"}};
  in.arrivals = {"arm_svc"};
  in.models = {{"arm_svc", std::numeric_limits<std::uint64_t>::max()}};
  in.reply = PlanReply{7, Verdict::solved, "", {{{"ground", "a"}, "x", "why"}}, testing::images({"a", "b"})};
  temporal::PlanActivity& activity = in.reply->plan.activities[0];
  activity.pre = temporal::compare("battery", temporal::ConditionOp::ge, 12.5);
  activity.impacts = {{"battery", temporal::ImpactKind::rate, temporal::ImpactWhen::during, -3.0}};
  in.reply->plan.decisions = {{"d", "ground", {{"one", {"a"}}, {"two", {}}}, 3}};
  in.reply->plan.tokens = {{"nav", temporal::state("idle"), 1, 2}};
  in.reply->plan.function_values = {{"f", {"x"}, 1e300, "o", 3, Time(9)}};
  return in;
}

TEST(Archive, GivesBackExactlyWhatItTook) {
  const ReactorInputs in = rich_inputs();
  const std::string bytes = to_bytes(in);
  const auto out = from_bytes<ReactorInputs>(bytes);
  EXPECT_EQ(to_bytes(out), bytes);
  EXPECT_EQ(out.goals, in.goals);
  EXPECT_EQ(out.observations[0].value, in.observations[0].value);
  EXPECT_EQ(out.reply->plan, in.reply->plan);
  EXPECT_EQ(out.models[0].version, in.models[0].version);
  EXPECT_EQ(out.acks[0].attempt, in.acks[0].attempt);
}

TEST(Archive, KeepsNumbersThatAreNone) {
  const auto out = from_bytes<GoalRequest>(
      to_bytes(testing::photo("a", GoalClass::hard, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isnan(out.utility[0]));
}

// Whatever stands in a file, reading it ends with values or with an ArchiveError.
TEST(Archive, DamagedBytesAreRefusedOrRead) {
  const std::string bytes = to_bytes(rich_inputs());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(from_bytes<ReactorInputs>(bytes.substr(0, size)), ArchiveError) << size;
  std::mt19937_64 random(1);
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    damaged[random() % damaged.size()] = static_cast<char>(random());
    try {
      from_bytes<ReactorInputs>(damaged);
    } catch (const ArchiveError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace roci::exec
