// When a run of the simulated world ends, on a live clock a thousand times as fast as the wall's.
#include <gtest/gtest.h>

#include "services/process/domain_claim.hpp"
#include "services/transport/plug_ins.hpp"
#include "sim_svc/run_end_service.hpp"

namespace roci::sim {
namespace {

class RunEndTest : public ::testing::Test {
 protected:
  services::Node live() const {
    services::node::NodeOptions options;
    options.name = "sim_svc";
    options.live_scale = 1000;
    services::transport::TransportOptions connection;
    connection.domain = domain_.id();
    connection.participant = "sim_svc";
    return {options, services::transport::open_transport("inproc", connection)};
  }
  static v1::MissionStatus status(v1::MissionPhase phase, const std::string& outcome) {
    v1::MissionStatus out;
    out.executive("exec_svc");
    out.phase(phase);
    out.goals_open(1);
    out.outcome(outcome);
    return out;
  }
  // Farewells take a second of mission time: this is many of them.
  void let_pass() {
    const temporal::Time until = node.now() + std::chrono::seconds(20);
    while (node.now() < until) node.spin_once(std::chrono::milliseconds(1));
  }

  services::process::DomainClaim domain_;
  services::Node node = live();
  bool nothing_to_come = true;
  int ended = 0;
  RunEnd run_end{node, [this] { return nothing_to_come; }, [this] { ++ended; }};
};

TEST_F(RunEndTest, EndsOnceTheMissionIsOverAndNothingIsToCome) {
  run_end.note(status(v1::PHASE_EXECUTING, ""));
  let_pass();
  EXPECT_EQ(ended, 0);
  nothing_to_come = false;
  run_end.note(status(v1::PHASE_FINISHED, "achieved"));
  let_pass();
  EXPECT_EQ(ended, 0);
  nothing_to_come = true;
  run_end.check();
  let_pass();
  EXPECT_EQ(ended, 1);
}

TEST_F(RunEndTest, AGoalThatComesDuringTheFarewellKeepsItOpen) {
  run_end.note(status(v1::PHASE_FINISHED, "achieved"));
  run_end.note(status(v1::PHASE_EXECUTING, ""));
  let_pass();
  EXPECT_EQ(ended, 0);
}

// The simulator hung; what it hears first is that it was given up. Its observations tell otherwise.
TEST_F(RunEndTest, StaysOpenWhileALiveRobotThatWasMadeSafeMayBeHeardAgain) {
  run_end.note(status(v1::PHASE_SAFE, "failed"));
  let_pass();
  EXPECT_EQ(ended, 0);
  run_end.note(status(v1::PHASE_EXECUTING, ""));
  run_end.note(status(v1::PHASE_FINISHED, "achieved"));
  let_pass();
  EXPECT_EQ(ended, 1);
}

}  // namespace
}  // namespace roci::sim
