#include "services/transport/lossy_transport.hpp"

#include <gtest/gtest.h>

#include "services/transport/plug_ins.hpp"
#include "tests/contract/support/inbox.hpp"
#include "tests/contract/support/profiles.hpp"

namespace roci::services {
namespace {

using contract::goal;
using contract::goal_endpoint;
using contract::Inbox;

constexpr int kCount = 2000;

// A marker on a reliable topic cannot tell when the last best-effort sample is through: keep-all samples and
// a last one that is sent until it arrives can.
transport::QosSettings best_effort() { return {.reliable = false, .history_depth = 0}; }

// The goals of `kCount` that a reader gets over a network of this quality.
std::vector<std::string> survivors(const transport::Loss& loss, const transport::QosSettings& qos,
                                   int domain) {
  const auto sender = transport::open_transport("inproc", {.domain = domain});
  const auto receiver = transport::make_lossy(transport::open_transport("inproc", {.domain = domain}), loss);
  Inbox inbox;
  const auto writer = sender->create_writer(goal_endpoint(qos), {});
  const auto reader = receiver->create_reader(goal_endpoint(qos), inbox.reader_events());
  for (int i = 0; i < kCount; ++i) writer->write(goal("goal", i));
  const auto over = [&inbox] { return !inbox.goals().empty() && inbox.goals().back().starts_with("end"); };
  for (int i = 0; i < 100 && !inbox.wait_until(over, std::chrono::milliseconds(50)); ++i)
    writer->write(goal("end", i));
  auto goals = inbox.goals();
  while (!goals.empty() && goals.back().starts_with("end")) goals.pop_back();
  return goals;
}

std::vector<std::string> all_goals() {
  std::vector<std::string> goals;
  for (int i = 0; i < kCount; ++i) goals.push_back("goal=" + std::to_string(i));
  return goals;
}

TEST(LossyTransport, LosesTheGivenFractionAndKeepsTheOrder) {
  const auto goals = survivors({.fraction = 0.2, .seed = 7}, best_effort(), 1001);
  EXPECT_NEAR(static_cast<double>(goals.size()), 0.8 * kCount, 0.03 * kCount);
  const auto all = all_goals();
  auto next = all.begin();
  for (const auto& survivor : goals) {
    next = std::find(next, all.end(), survivor);
    ASSERT_NE(next, all.end()) << survivor << " out of order";
  }
}

TEST(LossyTransport, TheSeedDecidesWhichSamplesAreLost) {
  const auto first = survivors({.fraction = 0.5, .seed = 7}, best_effort(), 1002);
  EXPECT_EQ(first, survivors({.fraction = 0.5, .seed = 7}, best_effort(), 1003));
  EXPECT_NE(first, survivors({.fraction = 0.5, .seed = 8}, best_effort(), 1004));
}

TEST(LossyTransport, DelaysWhatArrives) {
  const auto start = std::chrono::steady_clock::now();
  const auto goals = survivors({.fraction = 0, .delay = std::chrono::milliseconds(60)}, best_effort(), 1005);
  EXPECT_EQ(goals, all_goals());
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(60));
}

TEST(LossyTransport, ReliableTopicsPassUntouched) {
  EXPECT_EQ(survivors({.fraction = 1}, contract::request(), 1006), all_goals());
}

TEST(LossyTransport, IsChosenByTheEnvironment) {
  setenv("ROCI_LOSS", "1:1:0", 1);
  const auto transport = transport::open_transport("inproc", {.domain = 1007});
  unsetenv("ROCI_LOSS");
  Inbox lossy, whole;
  const auto writer = transport->create_writer(goal_endpoint(best_effort()), {});
  const auto lossy_reader = transport->create_reader(goal_endpoint(best_effort()), lossy.reader_events());
  const auto plain = transport::open_transport("inproc", {.domain = 1007});
  const auto whole_reader = plain->create_reader(goal_endpoint(best_effort()), whole.reader_events());
  writer->write(goal("photo", 1));
  ASSERT_TRUE(whole.wait_for_samples(1));
  EXPECT_FALSE(
      lossy.wait_until([&lossy] { return !lossy.samples().empty(); }, std::chrono::milliseconds(20)));
}

}  // namespace
}  // namespace roci::services
