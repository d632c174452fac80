#include "science_svc/watch/watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "science_svc/science_service.hpp"
#include "science_svc/watch/watch_file.hpp"
#include "services/publisher.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::science::watch {
namespace {

using testing::HasSubstr;
using namespace std::chrono_literals;

Rule pump_rule() {
  Rule out;
  out.timeline = "digger.pump.*.state";
  out.state = "leaks";
  out.goal_kind = "mend";
  out.arguments = {{"pump", "*"}, {"how", "seal-*"}};
  return out;
}

TEST(Watch, TheStarStandsForAtLeastOneCharacter) {
  EXPECT_EQ(match("a.*.c", "a.b.c"), "b");
  EXPECT_EQ(match("a.*", "a.b.c"), "b.c");
  EXPECT_EQ(match("a.b", "a.b"), "");
  EXPECT_FALSE(match("a.*.c", "a..c"));
  EXPECT_FALSE(match("a.*.a", "a.a"));
  EXPECT_FALSE(match("a.b", "a.bc"));
}

TEST(Watch, AskForAGoalWhenTheStateIsEntered) {
  Watch watch({pump_rule()});
  EXPECT_TRUE(watch.observe("digger.pump.p7.state", "tight").empty());
  const auto wishes = watch.observe("digger.pump.p7.state", "leaks");
  ASSERT_EQ(wishes.size(), 1U);
  EXPECT_EQ(wishes[0].id, "watch-mend-p7");
  EXPECT_EQ(wishes[0].goal_kind, "mend");
  EXPECT_EQ(wishes[0].arguments, (std::map<std::string, std::string>{{"pump", "p7"}, {"how", "seal-p7"}}));
  EXPECT_EQ(wishes[0].importance, GoalClass::opportunistic);
}

TEST(Watch, AsksOnceForAsLongAsItLasts) {
  Watch watch({pump_rule()});
  EXPECT_EQ(watch.observe("digger.pump.p7.state", "leaks").size(), 1U);  // as first seen
  EXPECT_TRUE(watch.observe("digger.pump.p7.state", "leaks").empty());
  EXPECT_TRUE(watch.observe("digger.pump.p7.state", "tight").empty());
  const auto again = watch.observe("digger.pump.p7.state", "leaks");
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].id, "watch-mend-p7-2");
  EXPECT_EQ(watch.observe("digger.pump.p8.state", "leaks").at(0).id, "watch-mend-p8");
  EXPECT_TRUE(watch.observe("digger.valve.p8.state", "leaks").empty());
}

TEST(Watch, AFurtherOneThatBeginsAnewAsksUnderTheSameIds) {
  Watch first({pump_rule()}), second({pump_rule()});
  first.observe("digger.pump.p1.state", "leaks");
  const auto before = first.observe("digger.pump.p2.state", "leaks");
  EXPECT_EQ(second.observe("digger.pump.p2.state", "leaks").at(0).id, before.at(0).id);
}

TEST(Watch, RemembersABoundedNumberOfTimelines) {
  Watch watch({pump_rule()});
  for (std::size_t i = 0; i < kTimelines; ++i) watch.observe("digger.pump.p" + std::to_string(i) + ".state", "tight");
  EXPECT_TRUE(watch.full());
  EXPECT_TRUE(watch.observe("digger.pump.new.state", "leaks").empty());
  EXPECT_EQ(watch.observe("digger.pump.p1.state", "leaks").size(), 1U);
}

class WatchFile : public testing::Test {
 protected:
  mission::Entry mission(const std::string& text) {
    std::filesystem::create_directories(folder_ / "scenarios");
    std::ofstream(folder_ / "mission.yaml") << text;
    std::ofstream(folder_ / "scenarios" / "nominal.yaml") << "duration_s: 100\n";
    return mission::Entry::load(folder_ / "mission.yaml");
  }
  std::string fault_of(const std::string& text) {
    try {
      read_rules(mission(text));
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return "";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string("roci_watch_") + testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(WatchFile, HoldsRules) {
  const auto rules = read_rules(mission(
      "watch:\n  - {timeline: 'a.*', state: hot, goal_kind: cool, arguments: {what: '*'}, class: hard, utility: 3}\n"
      "  - {timeline: b, state: off, goal_kind: start}\n"));
  ASSERT_EQ(rules.size(), 2U);
  EXPECT_EQ(rules[0].arguments.at("what"), "*");
  EXPECT_EQ(rules[0].importance, GoalClass::hard);
  EXPECT_EQ(rules[0].utility, 3);
  EXPECT_EQ(rules[1].importance, GoalClass::opportunistic);
  EXPECT_TRUE(read_rules(mission("name: m\n")).empty());
}

TEST_F(WatchFile, FaultsNameTheirPlaceAndRemedy) {
  const std::string head = "watch:\n  - {timeline: 'a.*', state: hot, goal_kind: cool, ";
  EXPECT_THAT(fault_of(head + "clas: hard}\n"), HasSubstr("mission.yaml:2:"));
  EXPECT_THAT(fault_of(head + "class: hrd}\n"), HasSubstr("did you mean 'hard'?"));
  EXPECT_THAT(fault_of("watch:\n  - {timeline: 'a.*.*', state: hot, goal_kind: cool}\n"), HasSubstr("more than one *"));
  EXPECT_THAT(fault_of("watch:\n  - {timeline: a, state: hot, goal_kind: cool, arguments: {what: '*'}}\n"),
              HasSubstr("nothing stands for the *"));
  EXPECT_THAT(fault_of("watch:\n  - {state: hot, goal_kind: cool}\n"), HasSubstr("timeline"));
}

// The service as it runs: no detector, no map; an observation becomes a goal and an event.
TEST_F(WatchFile, TheServiceRaisesTheGoal) {
  mission("watch:\n  - {timeline: 'digger.pump.*', state: leaks, goal_kind: mend, arguments: {pump: '*'}, class: optional}\n");
  services::RunSettings settings;
  settings.mission = folder_;
  services::SimRun run({"master", "science_svc"});
  services::Node& master = run.add("master");
  const auto service = make_service(run.add("science_svc"), settings);
  const auto observations = services::advertise(master, services::topics::observation);
  std::vector<v1::Goal> goals;
  std::vector<std::string> events;
  services::subscribe(master, services::topics::goal, [&](const v1::Goal& goal) { goals.push_back(goal); });
  services::subscribe(master, services::topics::event, [&](const v1::Event& event) { events.push_back(event.code()); });
  const auto tell = [&](const std::string& state) {
    v1::Observation out;
    out.timeline("digger.pump.p7");
    out.observed().kind(v1::VALUE_STATE);
    out.observed().state(state);
    observations.write(out);
  };
  master.at(1s, [&] { tell("tight"); });
  master.at(2s, [&] { tell("leaks"); });
  master.at(3s, [&] { tell("leaks"); });
  master.at(4s, [&] { master.stop(); });
  run.run();
  ASSERT_EQ(goals.size(), 1U);
  EXPECT_EQ(goals[0].issuer(), "science_svc");
  EXPECT_EQ(goals[0].id(), "watch-mend-p7");
  EXPECT_EQ(goals[0].goal_kind(), "mend");
  EXPECT_EQ(goals[0].importance(), v1::GOAL_OPTIONAL);
  ASSERT_EQ(goals[0].arguments().size(), 1U);
  EXPECT_EQ(goals[0].arguments()[0].value(), "p7");
  EXPECT_THAT(events, testing::Contains("watch.goal"));
}

}  // namespace
}  // namespace roci::science::watch
