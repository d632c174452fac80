// The paper's module for the arm, its text as figure 2 prints it, between the planner's service and the arm's, on
// every transport: the plan's durations and costs are the arm's (R38).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "arm_svc/arm_service.hpp"
#include "services/process/domain_claim.hpp"
#include "tests/unit/planner_svc/service/road_planning.hpp"

namespace roci::planner {
namespace {

using namespace std::chrono_literals;
using namespace testing;
namespace topics = services::topics;

// Stellar, figure 2, in a domain that uses it; its lines 4 to 7 are the paper's.
const std::string kFigureTwo = R"((define (domain walk)
  (:requirements :typing :durative-actions :numeric-fluents)
  (:types slot)
  (:modules (:module ef_orbitalrarmplanner
    (:function (ra_move_dur ?from ?to - slot))
    (:function (ra_move_energy ?to - slot))
  ))
  (:predicates (arm-at ?s - slot))
  (:functions (energy))
  (:durative-action move :parameters (?from ?to - slot) :duration (= ?duration (ra_move_dur ?from ?to))
    :condition (and (at start (arm-at ?from)) (at start (>= (energy) (ra_move_energy ?to))))
    :effect (and (at start (not (arm-at ?from))) (at start (decrease (energy) (ra_move_energy ?to)))
                 (at end (arm-at ?to)))))
)";

constexpr const char* kMission = R"(
  module: ef_orbitalrarmplanner
  functions:
    ra_move_dur: {parameters: [slot, slot], gives: duration, from: "?1", to: "?2"}
    ra_move_energy: {parameters: [slot], gives: energy, from: home, to: "?1"}
planner: {function_timeout_s: 20, simulated: {base_s: 0.5, per_evaluation_s: 0}}
)";

class FigureTwo : public ::testing::TestWithParam<std::pair<const char*, RoadVendors>> {
 protected:
  FigureTwo() {
    std::filesystem::create_directories(settings_.mission);
    settings_.run_folder = settings_.mission;
    const std::string arm = ROCI_SOURCE_DIR "/tests/unit/arm_svc/rail/";
    std::ofstream(settings_.mission / "mission.yaml")
        << "arm:\n  model: " << arm << "arm.urdf\n  poses: " << arm << "poses.yaml" << kMission;
  }
  ~FigureTwo() override { std::filesystem::remove_all(settings_.mission); }

  // Asked for a way from s0 to s1 with this much energy.
  v1::PlanReply plan(const std::string& energy) {
    const services::process::DomainClaim domain;
    const RoadVendors& vendors = GetParam().second;
    services::SimRun run({"client", "planner_svc", "arm_svc"}, domain.id());
    services::Node& client = run.add("client", 1, vendors.client);
    services::Client<v1::PlanRequest, v1::PlanReply> calls(client, topics::plan_request);
    const auto planner = make_service(run.add("planner_svc", 1, vendors.planner), settings_);
    const auto arm = arm::make_service(run.add("arm_svc", 1, vendors.owner), settings_);
    v1::PlanReply reply;
    client.at(1s, [&] {
      calls.call(plan_request(kFigureTwo,
                              "(define (problem p) (:domain walk) (:objects s0 s1 s2 - slot)\n"
                              "  (:init (arm-at s0) (= (energy) " +
                                  energy + ")) (:goal (arm-at s1)))"),
                 "planner_svc", 50s,
                 [&](const services::CallResult<v1::PlanReply>& result) { reply = result.reply; });
    });
    client.at(60s, [&client] { client.stop(); });
    run.run();
    return reply;
  }

  services::RunSettings settings_ = [] {
    services::RunSettings settings;
    settings.mission =
        std::filesystem::temp_directory_path() / ("roci_figure_two_" + std::to_string(::getpid()));
    return settings;
  }();
};

TEST_P(FigureTwo, TheArmAnswersItsFunctionsAsTheyStand) {
  const v1::PlanReply reply = plan("1000000");
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "move s0 s1");
  const auto& uses = reply.solution().function_values();
  const auto value_of = [&](const std::string& function, const std::vector<std::string>& arguments) {
    const auto use = std::ranges::find_if(uses, [&](const v1::FunctionValueUse& candidate) {
      return candidate.function() == function && candidate.arguments() == arguments;
    });
    if (use == uses.end()) return 0.0;
    EXPECT_EQ(use->owner(), "arm_svc");
    EXPECT_NE(use->model_version(), 0U);
    return use->number();
  };
  const double seconds = value_of("ra_move_dur", {"s0", "s1"});
  EXPECT_GT(seconds, 1.0);
  EXPECT_GT(value_of("ra_move_energy", {"s1"}), 10.0);
  EXPECT_NEAR(static_cast<double>(reply.solution().activities()[0].duration_lower_us()) / 1e6, seconds, 1e-3);
}

TEST_P(FigureTwo, WithoutTheEnergyThatTheArmSaysThereIsNoPlan) {
  EXPECT_EQ(plan("10").verdict_code(), v1::VERDICT_UNSOLVABLE);
}

INSTANTIATE_TEST_SUITE_P(Transports, FigureTwo, ::testing::ValuesIn(kRoadTransports),
                         [](const auto& parameter) { return std::string(parameter.param.first); });

}  // namespace
}  // namespace roci::planner
