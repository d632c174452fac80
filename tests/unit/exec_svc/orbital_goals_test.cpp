// Goals whose arguments are objects of the mission, and facts that stand in every problem: the orbital mission's data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/mission/entry.hpp"
#include "exec_svc/problem/problem_writer.hpp"

namespace roci::exec {
namespace {

namespace fs = std::filesystem;
using goals::GoalRequest;
using mission::MissionModel;
using temporal::state;
using ::testing::AllOf, ::testing::HasSubstr;

const std::string kMission = std::string(ROCI_SOURCE_DIR) + "/missions/orbital";

GoalRequest install(const std::string& module, const std::string& slot) {
  GoalRequest out;
  out.key = {"ground", module + "-in-" + slot};
  out.kind = "install";
  out.arguments = {{"module", module}, {"slot", slot}};
  return out;
}

class OrbitalGoals : public ::testing::Test {
 protected:
  std::string fault(const GoalRequest& goal) {
    const auto [taken, record] = goals.submit(goal, temporal::seconds(100));
    return taken == goals::GoalSet::Disposition::rejected ? record->reason : "accepted";
  }
  MissionModel mission = mission::read_mission(kMission);
  goals::GoalSet goals{mission};
};

TEST_F(OrbitalGoals, NameWhatTheMissionHas) {
  EXPECT_EQ(fault(install("radar-1", "s3")), "accepted");
  EXPECT_THAT(fault(install("radar-1", "s33")),
              AllOf(HasSubstr("argument 'slot' is 's33'; the mission has no such socket, it has: s0, s1, "),
                    HasSubstr("did you mean 's3'?")));
  EXPECT_THAT(fault(install("radar-2", "s3")), HasSubstr("no such module, it has: power-1"));
  EXPECT_THAT(fault(install("s3", "s3")), HasSubstr("no such module"));         // of another type
  EXPECT_THAT(fault(install("radar-1", "home")), HasSubstr("no such socket"));  // a slot without a socket
}

TEST_F(OrbitalGoals, ComeWithWhatNeverChanges) {
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("walker.arm", state("idle-pose", {"home"}));
  beliefs.observe("walker.grapple", state("empty"));
  beliefs.observe("walker.fix", state("none"));
  beliefs.observe("walker.array", state("ready"));
  beliefs.observe("walker.battery", 500000.0);
  beliefs.observe("walker.module.radar-1", state("latched", {"s11"}));
  beliefs.observe("walker.slot.s3", state("free"));
  goals.submit(install("radar-1", "s3"), temporal::Time{0});
  const problem::Problem problem =
      problem::write_problem(mission, beliefs, goals, "p", temporal::Time{0}, temporal::Time{0});
  for (const char* fact : {"(serves radar-1 sounding)", "(seat camera-1 s4)", "(wanted radar-1 s3)",
                           "(lay-first radar-1 s11)", "(free s3)", "(arm-first home)"})
    EXPECT_THAT(problem.text, HasSubstr(fact));
  EXPECT_TRUE(problem.unusable_goals.empty());
  EXPECT_TRUE(problem.left_out.empty());
}

// What a goal has wanted binds no module once the goal has ended: a later goal may move it.
TEST_F(OrbitalGoals, LeaveNothingBehindWhenTheyHaveEnded) {
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("walker.arm", state("idle-pose", {"home"}));
  goals.submit(install("radar-1", "s3"), temporal::Time{0});
  goals.submit(install("camera-1", "s4"), temporal::Time{0});
  goals.set_state(install("radar-1", "s3").key, goals::GoalState::achieved, "");
  const problem::Problem problem =
      problem::write_problem(mission, beliefs, goals, "p", temporal::Time{0}, temporal::Time{0});
  EXPECT_THAT(problem.text, ::testing::Not(HasSubstr("(wanted radar-1 s3)")));
  EXPECT_THAT(problem.text, HasSubstr("(wanted camera-1 s4)"));
}

GoalRequest replace(const std::string& module) {
  GoalRequest out;
  out.key = {"ground", "replace-" + module};
  out.kind = "replace";
  out.arguments = {{"module", module}};
  return out;
}

// An engine that proves such a goal out of reach says so by its text: it is the one that leaves, and no other.
TEST_F(OrbitalGoals, WhatTimelinesCannotSayIsOneFactByItsText) {
  beliefs::Beliefs beliefs(mission);
  beliefs.observe("walker.arm", state("idle-pose", {"home"}));
  goals.submit(replace("camera-1"), temporal::Time{0});
  goals.submit(install("radar-1", "s3"), temporal::Time{0});
  const problem::Problem problem =
      problem::write_problem(mission, beliefs, goals, "p", temporal::Time{0}, temporal::Time{0});
  ASSERT_EQ(problem.goals.size(), 2U);
  ASSERT_EQ(problem.goals[0].achieved.nodes.size(), 1U);
  const std::string& text = problem.goals[0].achieved.nodes[0].timeline;
  EXPECT_THAT(text,
              ::testing::StartsWith("(exists (?b - module ?s - socket ?r - role) (and (seat camera-1 ?s)"));
  EXPECT_THAT(problem.text, HasSubstr(text)) << "the engine prints it from here";
  EXPECT_EQ(temporal::describe(problem.goals[1].achieved),
            "(installed radar-1 s3) = true and (works radar-1) = true");
}

// The mission's files with one text of one of them changed; what reading them says.
std::string fault_with(const std::string& right, const std::string& wrong) {
  const fs::path folder = fs::temp_directory_path() / ("roci_orbital_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  fs::copy_file(kMission + "/domain.pddl", folder / "domain.pddl", fs::copy_options::overwrite_existing);
  std::ostringstream text;
  text << std::ifstream(kMission + "/mission.yaml").rdbuf();
  std::string changed = text.str();
  changed.replace(changed.find(right), right.size(), wrong);
  std::ofstream(folder / "mission.yaml") << changed;
  std::string out;
  try {
    mission::read_mission(folder);
  } catch (const roci::mission::FileError& error) {
    out = error.what();
  }
  fs::remove_all(folder);
  return out;
}

TEST(OrbitalSlip, IsToldWithPlaceAndRemedy) {
  EXPECT_EQ(fault_with("(seat power-1 s0)", "(seat power-1 s0)"), "");
  EXPECT_THAT(fault_with("(seat power-1 s0)", "(saet power-1 s0)"), HasSubstr("no predicate 'saet'"));
  EXPECT_THAT(fault_with("(seat power-1 s0)", "(seat power-1)"),
              HasSubstr("'seat' has 2 arguments in the domain, not 1"));
  EXPECT_THAT(fault_with("slot: socket}", "slot: sokcet}"),
              HasSubstr("unknown kind of argument 'sokcet'; one of number, text, goal, or a type of the "
                        "domain's objects; did "
                        "you mean 'socket'?"));
}

}  // namespace
}  // namespace roci::exec
