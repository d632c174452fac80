// Who waits for a disk is heard meanwhile.
#include "services/process/disk_pause.hpp"

#include <gtest/gtest.h>

#include "services/node.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/topics/topics.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::services::process {
namespace {

class DiskPauseTest : public ::testing::Test {
 protected:
  Node node(const std::string& name, clock::ClockMode clock) const {
    node::NodeOptions options;
    options.name = name;
    options.clock = clock;
    transport::TransportOptions connection;
    connection.domain = domain_.id();
    connection.participant = name;
    return Node(options, transport::open_transport("inproc", connection));
  }
  DomainClaim domain_;
};

TEST_F(DiskPauseTest, WhoWaitsBeatsAsDegradedAndTellsItsSupervisor) {
  Node waiting = node("exec_svc", clock::ClockMode::live);
  Node other = node("launcher", clock::ClockMode::observer);
  int degraded = 0;
  subscribe(other, topics::heartbeat, [&](const v1::Heartbeat& beat) {
    degraded += beat.service() == "exec_svc" && beat.state() == v1::SERVICE_DEGRADED;
  });
  int turns = 0;
  waiting.on_turn([&] { ++turns; });
  waiting.spin_once(std::chrono::milliseconds(0));
  turns = 0;
  DiskPause pause(waiting);
  EXPECT_TRUE(pause.wait());
  EXPECT_FALSE(pause.wait());
  EXPECT_FALSE(pause.wait());
  EXPECT_GE(turns, 3);
  other.spin_once(std::chrono::milliseconds(0));
  EXPECT_EQ(degraded, 1) << "the newest of several";
}

// Before its loop it has nothing to say.
TEST_F(DiskPauseTest, WhoHasNotBegunMayWait) {
  Node waiting = node("exec_svc", clock::ClockMode::live);
  EXPECT_TRUE(DiskPause(waiting).wait());
}

}  // namespace
}  // namespace roci::services::process
