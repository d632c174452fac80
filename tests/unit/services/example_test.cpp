#include <gtest/gtest.h>

#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/example_service.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::services {
namespace {

using namespace std::chrono_literals;

TEST(ExampleService, TicksEachSecondAndAsksForPaths) {
  SimRun run({"master", "odometer", "pathplan_svc"});
  Node& master = run.add("master");
  Node& planner = run.add("pathplan_svc");
  const auto service = example::make_service(run.add("odometer"), {});

  serve(planner, topics::path_request, [](const v1::PathRequest& request, auto responder) {
    v1::PathReply reply;
    reply.length_m(request.goal_pose().x_m());
    responder.reply(reply);
  });
  std::vector<std::pair<std::int64_t, double>> seen;
  subscribe(master, topics::observation, [&](const v1::Observation& observation) {
    seen.emplace_back(master.now().count(), observation.observed().number());
  });
  master.after(2500ms, [hazards = advertise(master, topics::hazard)] {
    v1::Hazard hazard;
    hazard.id("rock");
    hazard.x_m(7);
    hazards.write(hazard);
  });
  master.after(4s, [&master] { master.stop(); });
  run.run();

  const std::vector<std::pair<std::int64_t, double>> expected{{1'000'000, 0}, {2'000'000, 0}, {3'000'000, 7}};
  ASSERT_GE(seen.size(), expected.size());
  seen.resize(expected.size());
  EXPECT_EQ(seen, expected);
}

}  // namespace
}  // namespace roci::services
