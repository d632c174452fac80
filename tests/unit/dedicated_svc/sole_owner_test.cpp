// A timeline has one owner, by the files of a mission.
#include "dedicated_svc/methods/sole_owner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/mission/mission_file.hpp"

namespace roci::dedicated::methods {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class SoleOwner : public testing::Test {
 protected:
  SoleOwner() : folder_(fs::temp_directory_path() / ("roci_sole_owner_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    write("a.yaml", "format: 1\nname: m\ndedicated:\n  timeline: scout.locomotion\n  subsystem: s\n");
    write("b.yaml", "format: 1\nname: m\ndedicated:\n  timeline: scout.locomotion\n  subsystem: t\n");
  }
  ~SoleOwner() override { fs::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  void mission(const std::string& more) const {
    write("mission.yaml",
          "format: 1\nname: m\nrobots: [scout]\nservices:\n"
          "  - {name: a, program: dedicated_svc, robot: scout, settings: a.yaml}\n" +
              more);
  }
  // What is told of the service `a`; empty: nothing.
  std::string told() const {
    try {
      check_sole_owner(mission::load_mission_file(folder_ / "a.yaml").at("dedicated"), folder_, "a");
    } catch (const mission::FileError& error) {
      return error.what();
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(SoleOwner, AnotherOwnerOfTheComponentIsNamed) {
  mission("components:\n  - {name: scout, timeline: scout.locomotion, owner: b}\n");
  EXPECT_THAT(told(),
              AllOf(HasSubstr("a.yaml:4:13: 'scout.locomotion' belongs to b, the owner of component 'scout'"),
                    HasSubstr("make a its owner")));
  mission("components:\n  - {name: scout, timeline: scout.locomotion, owner: a}\n");
  EXPECT_EQ(told(), "");
}

TEST_F(SoleOwner, AnotherDedicatedExecutiveOfTheTimelineIsNamed) {
  mission("  - {name: b, program: dedicated_svc, robot: scout, settings: b.yaml}\n");
  EXPECT_THAT(told(), HasSubstr("'scout.locomotion' is shown by b, too (b.yaml)"));
  mission(
      "  - {name: b, program: dedicated_svc, robot: scout, settings: b.yaml}\n"
      "components:\n  - {name: scout, timeline: scout.locomotion, owner: a}\n");
  EXPECT_EQ(told(), "") << "it is the one that may";
  mission("  - {name: b, program: dedicated_svc, robot: scout, settings: b.yaml}\n");
  write("b.yaml", "format: 1\nname: m\ndedicated:\n  timeline: scout.path\n  subsystem: t\n");
  EXPECT_EQ(told(), "");
  write("b.yaml", "format: 1\nname: m\ndedicated: faulty\n");
  EXPECT_EQ(told(), "") << "that is for the other to say";
}

TEST_F(SoleOwner, WithoutAMissionThereIsNobodyElse) { EXPECT_EQ(told(), ""); }

}  // namespace
}  // namespace roci::dedicated::methods
