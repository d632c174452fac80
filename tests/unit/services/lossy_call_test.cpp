// A call whose requests and replies are lost and doubled on the way, over each vendor.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/process/domain_claim.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/faulty_transport.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

class LossyCall : public testing::TestWithParam<const char*> {
 protected:
  // Turned by the test itself; mission time runs 100 times as fast as the wall.
  std::unique_ptr<Node> make(const std::string& name, Deliveries deliveries) const {
    node::NodeOptions options;
    options.name = name;
    options.vendor = GetParam();
    options.live_scale = 100;
    transport::TransportOptions transport;
    transport.domain = domain_.id();
    transport.participant = name;
    auto network = transport::open_transport(GetParam(), transport);
    return std::make_unique<Node>(
        options, std::make_unique<FaultyTransport>(std::move(network), std::move(deliveries)));
  }

  const process::DomainClaim domain_;
};

// The first two requests and the first four replies do not arrive, and everything behind them comes three times: the
// third request brings three replies, all of which are lost, and the fourth one those that arrive.
TEST_P(LossyCall, EndsOnceAndIsHandledOnce) {
  const auto faulty = [](const std::string& topic, int lost) {
    return [topic, lost](const std::string& on, int number) {
      return on != topic ? 1 : number <= lost ? 0 : 3;
    };
  };
  const auto caller = make("caller", faulty(topics::arm_motion.reply.name, 4));
  const auto owner = make("owner", faulty(topics::arm_motion.request.name, 2));
  int handled = 0;
  serve(*owner, topics::arm_motion, [&handled](const v1::ArmMotionRequest&, auto responder) {
    ++handled;
    responder.reply({});
  });
  const auto client = make_client(*caller, topics::arm_motion);
  std::vector<std::string> results;
  client.call({}, "owner", 10'000s,
              [&results](const auto& result) { results.emplace_back(to_string(result.status)); });
  while (client.statistics().late < 2) {
    caller->spin_once(1ms);
    owner->spin_once(1ms);
  }
  EXPECT_THAT(results, ElementsAre("ok"));
  EXPECT_EQ(handled, 1);
  EXPECT_GE(client.statistics().sent, 4U);
}

INSTANTIATE_TEST_SUITE_P(Transports, LossyCall, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::services
