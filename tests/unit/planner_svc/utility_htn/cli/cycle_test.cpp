// roci-network cycle: a flight of the engine is planned again from its record, and what is another plan is told.
#include "planner_svc/utility_htn/cli/cycle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "core/temporal/plan_delta.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/reading/binary.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner::utility_htn::cli {
namespace {

namespace fs = std::filesystem;
using temporal::seconds;
using testing::HasSubstr, testing::Not;

const fs::path kLander = ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml";

class CycleCommand : public testing::Test {
 protected:
  CycleCommand() {
    engine::Setup setup;
    setup.engine = "utility_htn";
    setup.robot = "lander";
    flown_.emplace(setup, reading::load_network(kLander));
    record_ = engine::record_head({setup.engine, setup.robot, {}, flown_->packed_model()});
  }
  ~CycleCommand() override { fs::remove(file_); }

  void step(const engine::StepInputs& inputs) {
    const engine::StepOutput output = flown_->step(inputs);
    record_ += engine::record_entry(inputs) + engine::record_entry(engine::outcome_of(output));
    if (output.delta) {
      ASSERT_EQ(temporal::apply(*output.delta, plan_), "");
    }
  }

  // A goal, a plan, its first activity a while later, and a battery that holds less than was foreseen.
  void fly() {
    engine::StepInputs inputs;
    inputs.receipt = engine::Receipt{0, 0, "", "", true};
    engine::Goal mission;
    mission.issuer = "ground";
    mission.id = mission.kind = "mission";
    inputs.goals.push_back(mission);
    inputs.observations = {{"lander.battery", 600'000.0, seconds(0)},
                           {"lander.lamp", temporal::state("lit"), seconds(0)}};
    step(inputs);
    ASSERT_GT(plan_.version, 0U);
    for (int minute = 1; minute <= 30; ++minute) {
      engine::StepInputs later;
      later.now = seconds(60.0 * minute);
      later.receipt = engine::Receipt{plan_.version, 0, "", "", true};
      later.last_version = plan_.version;
      later.observations = {{"lander.battery", 600'000.0 - 9'000.0 * minute, later.now}};
      step(later);
    }
  }

  ExitCode again(std::uint64_t until = 0, bool json = false) {
    std::ofstream(file_, std::ios::binary) << record_;
    out_.str("");
    return cycle(file_, until, {out_, errors_, json});
  }

  std::optional<adapter::UtilityEngine> flown_;
  temporal::FlexiblePlan plan_;
  std::string record_;
  const fs::path file_ = fs::temp_directory_path() / ("roci_cycle_" + std::to_string(::getpid()) + ".steps");
  std::ostringstream out_, errors_;
};

TEST_F(CycleCommand, PlansEveryCycleOfAFlightAgain) {
  fly();
  EXPECT_EQ(again(), done) << out_.str();
  EXPECT_THAT(out_.str(), HasSubstr("31 steps, "));
  EXPECT_THAT(out_.str(), HasSubstr("all as flown"));
  EXPECT_THAT(out_.str(), HasSubstr("version " + std::to_string(plan_.version) + ", checksum "));
  EXPECT_THAT(out_.str(), HasSubstr("explored"));
  EXPECT_EQ(again(2), done);
  EXPECT_THAT(out_.str(), HasSubstr("cycle 2, "));
  EXPECT_THAT(out_.str(), Not(HasSubstr("cycle 3, ")));
  EXPECT_EQ(again(2, true), done);
  EXPECT_THAT(out_.str(), HasSubstr("\"as_flown\": true"));
}

TEST_F(CycleCommand, TellsWhereAPlanIsNotAsItWasFlown) {
  fly();
  engine::StepInputs inputs;
  inputs.now = seconds(4'000);
  record_ += engine::record_entry(inputs) +
             engine::record_entry(engine::StepOutcome{
                 .account = "schedule; 1 explored", .version = 99, .delta = 1, .fault = ""});
  EXPECT_EQ(again(), faulty);
  EXPECT_THAT(out_.str(), HasSubstr("differs from the flight: version 99, checksum 0000000000000001"));
  EXPECT_THAT(out_.str(), HasSubstr("1 cycles differ from the flight"));
}

TEST_F(CycleCommand, RefusesWhatIsNoRecordOfThisEngine) {
  record_ = "network: a\n";
  EXPECT_EQ(again(), faulty);
  EXPECT_THAT(errors_.str(), HasSubstr("at byte 0: no record of planning steps"));
  record_ = engine::record_head({"chain", "", {}, ""});
  EXPECT_EQ(again(), faulty);
  EXPECT_THAT(errors_.str(), HasSubstr("it is a record of the engine 'chain'"));
  record_ = engine::record_head({"utility_htn", "", {}, "no network"});
  EXPECT_EQ(again(), faulty);
  EXPECT_THAT(errors_.str(), HasSubstr("its network cannot be used"));
  EXPECT_EQ(cycle("/nowhere/1.steps", 0, {out_, errors_, false}), wrong_use);
}

}  // namespace
}  // namespace roci::planner::utility_htn::cli
