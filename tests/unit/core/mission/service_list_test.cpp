#include "core/mission/service_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace roci::mission {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ServiceListTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("roci_services_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(folder_ / "drivers");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  ServiceList read(const std::string& text) {
    std::ofstream(folder_ / "mission.yaml") << text;
    return load_service_list(folder_);
  }
  std::string error_of(const std::string& text) {
    try {
      read(text);
    } catch (const FileError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

TEST_F(ServiceListTest, ReadsNamesProgramsRobotsAndSettings) {
  std::ofstream(folder_ / "b.yaml") << "name: b\n";
  std::ofstream(folder_ / "drivers/lamp") << "";
  const ServiceList list = read(
      "robots: [a, b]\n"
      "services:\n"
      "  - {name: sim_svc, clock: master}\n"
      "  - {name: a.exec, program: exec_svc, robot: a, standby: true}\n"
      "  - {name: b.exec, program: exec_svc, robot: b, settings: b.yaml, vendor: cyclonedds}\n"
      "  - {name: lamp, program: ./drivers/lamp, arguments: [--dim, fast]}\n");
  EXPECT_THAT(list.robots, ElementsAre("a", "b"));
  EXPECT_THAT(list.names(), ElementsAre("sim_svc", "a.exec", "b.exec", "lamp"));
  EXPECT_EQ(list.clock_master()->name, "sim_svc");
  EXPECT_EQ(list.find("a.exec")->settings.filename(), "mission.yaml");
  EXPECT_TRUE(list.find("a.exec")->paired);
  EXPECT_EQ(list.find("b.exec")->settings.filename(), "b.yaml");
  EXPECT_EQ(list.find("b.exec")->vendor, "cyclonedds");
  EXPECT_EQ(std::filesystem::path(list.find("lamp")->program).filename(), "lamp");
  EXPECT_THAT(list.find("lamp")->arguments, ElementsAre("--dim", "fast"));
  EXPECT_EQ(list.find("nobody"), nullptr);
}

TEST_F(ServiceListTest, FindsWhoServesARobot) {
  const ServiceList list = read(
      "robots: [a, b]\n"
      "services:\n"
      "  - {name: planner_svc}\n"
      "  - {name: arm.a, program: arm_svc, robot: a}\n"
      "  - {name: path.1, program: pathplan_svc, robot: b}\n"
      "  - {name: path.2, program: pathplan_svc, robot: b}\n");
  EXPECT_EQ(list.serving("arm_svc", "a"), "arm.a");
  EXPECT_EQ(list.serving("arm_svc", "b"), "");
  EXPECT_EQ(list.serving("planner_svc", "b"), "planner_svc") << "the team's serves every robot";
  EXPECT_EQ(list.serving("pathplan_svc", "b"), "") << "a choice between two is nobody's to guess";
  EXPECT_EQ(list.clock_master(), nullptr);
}

// The run folder is shared: what one service alone writes keeps its plain name.
TEST_F(ServiceListTest, FilesOfSeveralInstancesAreToldApart) {
  const ServiceList list = read(
      "services:\n"
      "  - {name: exec.a, program: exec_svc}\n"
      "  - {name: exec.b, program: exec_svc}\n"
      "  - {name: planner.a, program: planner_svc}\n");
  EXPECT_EQ(list.file_name("exec.a", "journal.sqlite"), "exec.a.journal.sqlite");
  EXPECT_EQ(list.file_name("planner.a", "calls"), "calls");
  EXPECT_EQ(list.file_name("nobody", "calls"), "calls");
  EXPECT_EQ(list.of_program("exec_svc").size(), 2U);
}

TEST_F(ServiceListTest, RefusesWithPlaceAndRemedy) {
  EXPECT_THAT(error_of("name: m\n"), HasSubstr("names no services"));
  EXPECT_THAT(error_of("services: []\n"), HasSubstr("names no services"));
  EXPECT_THAT(error_of("services:\n  - {name: a}\n  - {name: a}\n"), HasSubstr("'a' stands twice"));
  EXPECT_THAT(error_of("services:\n  - {name: a b}\n"), HasSubstr("mission.yaml:2:12: 'a b' is no name"));
  EXPECT_THAT(error_of("robots: [x]\nservices:\n  - {name: a, robot: y}\n"), HasSubstr("known: x"));
  EXPECT_THAT(error_of("services:\n  - {name: a, program: ./none}\n"), HasSubstr("there is no program"));
  EXPECT_THAT(error_of("services:\n  - {name: a, settings: none.yaml}\n"),
              HasSubstr("there is no settings file"));
  EXPECT_THAT(error_of("services:\n  - {name: a, clock: slave}\n"), HasSubstr("the only value is master"));
  EXPECT_THAT(error_of("services:\n  - {name: a, clock: master}\n  - {name: b, clock: master}\n"),
              HasSubstr("several services"));
  EXPECT_THAT(error_of("services:\n  - {name: a, colour: red}\n"), HasSubstr("colour"));
}

}  // namespace
}  // namespace roci::mission
