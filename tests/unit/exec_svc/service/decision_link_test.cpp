// Decisions on the wire: what who joins late still hears of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <set>
#include <string>

#include "exec_svc/decision_link_service.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::exec {
namespace {

using namespace std::chrono_literals;
using executive::DecisionState;
using ::testing::Contains;
using ::testing::Not;

reactor::ReactorOutputs told(const std::string& id, DecisionState state) {
  reactor::DecisionRecord decision;
  decision.status.decision = id;
  decision.status.resolver = "ground";
  decision.status.state = state;
  reactor::ReactorOutputs out;
  out.decisions.push_back(decision);
  return out;
}

// An executive of months asks again with each plan.
TEST(DecisionLink, ALateJoinerHearsOfWhatIsOpenAndOfTheNewestThatAreClosed) {
  constexpr int kClosed = 200, kTold = 64;
  services::SimRun run({"sim_svc", "exec_svc", "planner_svc"});
  run.master.restart_hold_s = 1000;  // mission time waits for the planner that was killed
  services::Node& master = run.add("sim_svc");
  services::Node& node = run.add("exec_svc");
  const DecisionLink link(node, [](const reactor::GivenAnswer&, const std::string&) {});
  node.at(0s, [&] { link.send(told("open", DecisionState::open)); });
  for (int number = 1; number <= kClosed; ++number) {
    const std::string id = "d" + std::to_string(number);
    node.at(number * 1s, [&link, id] { link.send(told(id, DecisionState::open)); });
    node.at(number * 1s + 500ms, [&link, id] { link.send(told(id, DecisionState::answered)); });
  }
  run.add("planner_svc").at(300s, [] { throw services::Crash{}; });
  master.at(400s, [&] { master.stop(); });
  run.start();
  run.wait_for_crash("planner_svc");
  std::set<std::string> heard;
  services::subscribe(run.add("planner_svc", 2), services::topics::decision,
                      [&](const v1::Decision& decision) { heard.insert(decision.id()); });
  run.run();
  EXPECT_EQ(heard.size(), kTold + 1U);
  EXPECT_THAT(heard, Contains("open"));
  EXPECT_THAT(heard, Contains("d" + std::to_string(kClosed)));
  EXPECT_THAT(heard, Not(Contains("d" + std::to_string(kClosed - kTold))));
}

}  // namespace
}  // namespace roci::exec
