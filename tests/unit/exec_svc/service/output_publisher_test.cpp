// Commands that wait for the leases of their owners.
#include "exec_svc/output_publisher_service.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "exec_svc/mission/mission_model.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::exec {
namespace {

using namespace std::chrono_literals;
using executive::CommandAction;

executive::Command photo(CommandAction action, const std::string& activity) {
  executive::Command out;
  out.action = action;
  out.activity = activity;
  out.owner = "sim_svc";
  out.command_name = "image";
  return out;
}

// The leases come right before the step that recalls: what it cancels is not sent first.
TEST(OutputPublisher, WhatIsCancelledWhileItWaitsIsNeverSent) {
  services::SimRun run({"sim_svc", "exec_svc"});
  services::Node& robot = run.add("sim_svc");
  services::Node& node = run.add("exec_svc");
  const mission::MissionModel mission = mission::read_mission(ROCI_SOURCE_DIR "/missions/planetary");
  journal::CrashPoints crash("", 1, [] {});
  OutputPublisher publisher(node, mission, 1, crash);
  bool may = false;
  publisher.let_commands_wait([&] { return may; });
  std::vector<v1::Command> heard;
  services::subscribe(robot, services::topics::command, [&](const v1::Command& one) { heard.push_back(one); });
  node.at(1s, [&] {
    reactor::ReactorOutputs out;
    out.commands = {photo(CommandAction::execute, "p1.1-photo"), photo(CommandAction::execute, "p1.2-photo")};
    publisher.send(out, 1, {});
  });
  node.at(2s, [&] {
    may = true;
    reactor::ReactorOutputs out;
    out.commands = {photo(CommandAction::query, "p1.2-photo"), photo(CommandAction::cancel, "p1.1-photo")};
    publisher.send(out, 1, {});
  });
  robot.at(3s, [&] { robot.stop(); });
  run.run();
  ASSERT_EQ(heard.size(), 3U);
  EXPECT_EQ(heard[0].activity(), "p1.2-photo");
  EXPECT_EQ(heard[0].action(), v1::COMMAND_EXECUTE);
  EXPECT_EQ(heard[1].action(), v1::COMMAND_QUERY);
  EXPECT_EQ(heard[2].activity(), "p1.1-photo");
  EXPECT_EQ(heard[2].action(), v1::COMMAND_CANCEL);
}

}  // namespace
}  // namespace roci::exec
