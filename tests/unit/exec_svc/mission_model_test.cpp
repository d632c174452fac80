// Every slip in a mission's files is found when they are read, with its place and what to do.
#include "exec_svc/mission/mission_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/mission/entry.hpp"
#include "exec_svc/problem/problem_writer.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec {

using mission::MissionModel;
using mission::read_mission;

namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

struct Slip {
  const char* file;
  const char* right;  // stands there once or more; its first place is changed
  const char* wrong;
  const char* error;  // part of what is told
};

void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.wrong; }

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

class MissionSlip : public ::testing::TestWithParam<Slip> {
 protected:
  MissionSlip() {
    fs::create_directories(folder_);
    for (const char* file : {"mission.yaml", "domain.pddl"})
      fs::copy_file(fs::path(ROCI_SOURCE_DIR "/missions/planetary") / file, folder_ / file,
                    fs::copy_options::overwrite_existing);
  }
  ~MissionSlip() override { fs::remove_all(folder_); }

  fs::path folder_ = fs::temp_directory_path() / ("roci_slip_" + std::to_string(::getpid()));
};

TEST_F(MissionSlip, TheMissionItselfHasNone) {
  const MissionModel mission = read_mission(folder_);
  EXPECT_EQ(mission.domain_name, "planetary");
  EXPECT_EQ(mission.actions.size(), 6U);
}

// A goal's success may be a condition over timelines; its states stand for the facts that the planner reads.
TEST_F(MissionSlip, AGoalMayBeAConditionInsteadOfFacts) {
  const std::string facts = "goal: [\"(sent image-{id})\"]";
  std::string text = text_of(folder_ / "mission.yaml");
  text.replace(text.find(facts), facts.size(), "achieved: {timeline: \"rover.image.image-{id}\", is: sent}");
  std::ofstream(folder_ / "mission.yaml") << text;
  const MissionModel mission = read_mission(folder_);
  EXPECT_THAT(mission.goal_kinds.at("photo").goal,
              ::testing::ElementsAre("(have-image image-{id})", "(sent image-{id})"));
  const goals::GoalRequest goal = testing::photo("a");
  beliefs::Beliefs beliefs = testing::standing_beliefs(mission);
  beliefs.observe("rover.image.image-a", temporal::state("stored"));
  EXPECT_FALSE(problem::is_achieved(mission, beliefs, goal));
  beliefs.observe("rover.image.image-a", temporal::state("sent"));
  EXPECT_TRUE(problem::is_achieved(mission, beliefs, goal));
}

TEST_P(MissionSlip, IsToldWithPlaceAndRemedy) {
  const Slip& slip = GetParam();
  std::string text = text_of(folder_ / slip.file);
  const auto at = text.find(slip.right);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(slip.right).size(), slip.wrong);
  std::ofstream(folder_ / slip.file) << text;
  try {
    read_mission(folder_);
    FAIL() << "read without an error";
  } catch (const roci::mission::FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr(slip.error));
    EXPECT_THAT(error.what(), ::testing::ContainsRegex("[^:]+/[a-z]+\\.(yaml|pddl):[0-9]+:[0-9]+: "));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Mission, MissionSlip,
    ::testing::Values(
        Slip{"domain.pddl", "(at ?l - location)", "(at ?l - locatoin)", "locatoin"},
        Slip{"domain.pddl", "(:predicates", "(predicates", "predicates"},
        Slip{"domain.pddl", "(define (domain planetary)", "(defin (domain planetary)", "defin"},
        Slip{"mission.yaml", "domain: domain.pddl", "domain: nowhere.pddl", "cannot read"},
        Slip{"mission.yaml", "  drive: {", "  drvie: {", "the domain has no action 'drvie'"},
        Slip{"mission.yaml", "  transmit: {owner: sim_svc, component: radio", "  #",
             "the domain's action 'transmit' is missing"},
        Slip{"mission.yaml", "component: nav, command", "component: wheels, command",
             "no component 'wheels'"},
        Slip{"mission.yaml", "type: image}", "type: imgae}", "no type 'imgae'; it has: "},
        Slip{"mission.yaml", "name: here, type: location", "name: here, type: lcoation",
             "no type 'lcoation'"},
        Slip{"mission.yaml", "(camera-idle)", "(camera-idel)", "no predicate 'camera-idel'; it has: "},
        Slip{"mission.yaml", "(dropped * ?1)", "(dropped *)",
             "'dropped' has 2 arguments in the domain, not 1"},
        Slip{"mission.yaml", "\"(battery)\"", "\"(batery)\"",
             "no function 'batery'; it has: battery, reserve"},
        Slip{"mission.yaml", "fact: \"(comm-window)\"", "fact: \"(window)\"", "no predicate 'window'"},
        Slip{"mission.yaml", "goal: [\"(sent image-{id})\"]", "goal: [\"(seen image-{id})\"]",
             "no predicate 'seen'"},
        Slip{"mission.yaml", "ack_timeout_s", "ack_timout_s", "unknown key 'ack_timout_s'; known here: "},
        Slip{"mission.yaml", "lateness: replan", "lateness: never", "one of: replan, push, deadline"},
        Slip{"mission.yaml", "lateness: replan", "contingency: pray",
             "no contingency 'pray' in this mission"},
        Slip{"mission.yaml", "lateness: replan", "retries: -1", "must be a whole number from 0"},
        Slip{"mission.yaml", "executive:", "executive:\n  recovery: hope",
             "cascade, static, ground, fe, replan"},
        Slip{"mission.yaml", "executive:", "executive:\n  start: soon", "one of: earliest, latest"},
        Slip{"mission.yaml", "executive:", "executive:\n  replanning: never", "one of: paused, situated"},
        Slip{"mission.yaml", "executive:",
             "contingencies: {stop-arm: {commands: [{owner: sim_svc, component: leg, command: "
             "stop}]}}\nexecutive:",
             "no component 'leg'"},
        Slip{"mission.yaml", "goal: [\"(sent image-{id})\"]", "achieved: {timeline: rover.battery, above: 3}",
             "only states of components and families"},
        Slip{"mission.yaml", "format: 1", "format: 2", "of format 2, this version reads up to 1"},
        Slip{"mission.yaml", "format: 1", "format: 0", "write 'format: 1'"},
        Slip{"mission.yaml", "[[1500, 2700]", "[[2700, 1500]", "from < to"},
        Slip{"mission.yaml", "work: 4000", "work: much", "number"}));

}  // namespace
}  // namespace roci::exec
