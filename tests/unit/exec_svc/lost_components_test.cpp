// A component whose owner is gone for good counts as lost in the mission's own time; until then it is waited for.
#include <filesystem>

#include "core/mission/entry.hpp"
#include "tests/unit/exec_svc/reactor_fixture.hpp"
#include "tests/unit/exec_svc/timeline_mission.hpp"

namespace roci::exec::testing {

using reactor::MissionPhase;
using reactor::ReactorInputs;

namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class LostComponentsTest : public ReactorTest {
 protected:
  LostComponentsTest() {
    mission.executive.fallback_timeout = seconds(600);
    for (mission::Component& component : mission.components)
      if (component.name == "camera")
        component.lost = mission::LossModel{{"sim_svc", "camera_computer"}, seconds(540), {"off", {}}};
    for (mission::Component& component : mission.components)
      if (component.name == "camera") component.states.push_back({"off", false, {}});
  }
  // It takes an image, and its owner dies at 20 s.
  void die_at_work() {
    run(20, robot_and({photo("a")}));
    ASSERT_EQ(reactor.phase(), MissionPhase::executing);
    robot_is_dead = true;
    robot_events.clear();
    run(21, lost("sim_svc"));
  }
  static ReactorInputs lost(const std::string& service) {
    ReactorInputs out;
    out.losses = {{service, "killed", true}};
    return out;
  }
  static ReactorInputs back(const std::string& service, const temporal::Value& camera) {
    ReactorInputs out;
    out.arrivals = {service};
    out.observations = {{"rover.camera", camera}};
    return out;
  }
  long calls() const { return std::ranges::count(trace, "call"); }
};

TEST_F(LostComponentsTest, OneThatDoesNotComeBackInItsTimeCountsAsLostAndTheRestIsPlannedWithoutIt) {
  die_at_work();
  EXPECT_THAT(trace, Contains("plan.broken")) << "its step has failed with the owner";
  run(20 + 539, {});
  EXPECT_THAT(trace, Not(Contains("component.lost")));
  EXPECT_EQ(calls(), 1) << "no plan counts on what cannot be heard";
  run(20 + 541, {});
  EXPECT_EQ(std::ranges::count(trace, "component.lost"), 1);
  EXPECT_EQ(reactor.observed().at("rover.camera"), temporal::Value(state("off")));
  EXPECT_EQ(calls(), 2);
}

TEST_F(LostComponentsTest, OneThatComesBackInTimeIsWaitedForNoLonger) {
  die_at_work();
  robot_is_dead = false;
  run(400, back("sim_svc", state("idle")));
  EXPECT_EQ(calls(), 2);
  run(2000, {});
  EXPECT_THAT(trace, Not(Contains("component.lost")));
  EXPECT_EQ(reactor.outcome(), "achieved");
}

// The time for the fall-back is shorter than what the mission gives a silent owner: the run does not end before.
TEST_F(LostComponentsTest, ARobotThatIsBeingMadeSafeGoesOnWithoutWhatIsLost) {
  mission.executive.fallback_timeout = seconds(60);
  die_at_work();
  run(300, {});
  EXPECT_EQ(reactor.phase(), MissionPhase::safe);
  EXPECT_EQ(reactor.outcome(), "") << "it may still come back, or count as lost";
  run(20 + 541, {});
  EXPECT_THAT(trace, Contains("robot.safe"));
  EXPECT_EQ(calls(), 2);
}

TEST_F(LostComponentsTest, AnyOfItsServicesIsEnoughAndWhatItStillTellsIsNotBelievedMeanwhile) {
  run(5, robot_and({photo("a")}));
  run(6, lost("camera_computer"));
  run(700, {});
  EXPECT_EQ(std::ranges::count(trace, "component.lost"), 1);
  ReactorInputs told;
  told.observations = {{"rover.camera", state("idle")}};
  run(710, told);
  EXPECT_EQ(reactor.observed().at("rover.camera"), temporal::Value(state("off")));
  run(720, back("camera_computer", state("idle")));
  EXPECT_EQ(reactor.observed().at("rover.camera"), temporal::Value(state("idle")));
  EXPECT_EQ(std::ranges::count(trace, "component.lost"), 1);
  run(730, lost("camera_computer"));
  run(1400, {});
  EXPECT_EQ(std::ranges::count(trace, "component.lost"), 2) << "another loss counts anew";
}

TEST_F(LostComponentsTest, ARobotAtRestMakesNoPlanThatCountsOnWhatCannotBeHeard) {
  run(5, robot_and({}));
  run(6, lost("camera_computer"));
  ReactorInputs asked;
  asked.goals = {photo("a")};
  run(500, asked);
  EXPECT_EQ(calls(), 0);
  run(560, {});
  EXPECT_EQ(calls(), 1);
}

TEST_F(LostComponentsTest, TheTimeRunsOnOverARestartOfTheExecutive) {
  die_at_work();
  const std::string kept = reactor.snapshot();
  reactor::Reactor restarted{mission};
  restarted.restore(kept);
  std::swap(reactor, restarted);
  run(20 + 541, {});
  EXPECT_THAT(trace, Contains("component.lost"));
}

TEST(LostComponentsFile, SaysWhatIsWrongWhereItStands) {
  TimelineMissionFile file;
  const std::string states = "states: {up: {}, in: {}, boring: {active: true}}";
  const auto fault = [&](const std::string& lost) { return file.fault(states, states + ", lost: " + lost); };
  EXPECT_EQ(fault("{for_s: 60, as: [in, hole-1]}"), "");
  const mission::MissionModel read = file.read();
  ASSERT_TRUE(read.components.front().lost);
  EXPECT_EQ(read.components.front().lost->without, std::vector<std::string>{"sim_svc"});
  EXPECT_EQ(read.components.front().lost->as, (temporal::State{"in", {"hole-1"}}));
  EXPECT_THAT(fault("{for_s: 0, as: [up]}"), HasSubstr("expected a time above 0"));
  EXPECT_THAT(fault("{for_s: 60, as: [boring]}"), HasSubstr("an inactive state of 'drill'"));
  EXPECT_THAT(fault("{for_s: 60, as: [gone]}"), HasSubstr("an inactive state of 'drill'"));
  EXPECT_THAT(fault("{for_s: 60}"), HasSubstr("as"));
}

}  // namespace
}  // namespace roci::exec::testing
