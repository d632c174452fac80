// The stated format of a mission file.
#include "core/mission/mission_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace roci::mission {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class MissionFile : public ::testing::Test {
 protected:
  ~MissionFile() override { fs::remove(file_); }

  std::string fault(const std::string& text) const {
    std::ofstream(file_) << text;
    try {
      load_mission_file(file_);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  fs::path file_ = fs::temp_directory_path() / ("roci_mission_file_" + std::to_string(::getpid()) + ".yaml");
};

TEST_F(MissionFile, OneThatStatesNoFormatIsOfTheFirst) {
  EXPECT_EQ(fault("name: old\n"), "");
  EXPECT_EQ(fault("format: 1\nname: new\n"), "");
}

TEST_F(MissionFile, ANewerFormatIsNeverMisread) {
  EXPECT_THAT(fault("name: n\nformat: 2\n"),
              HasSubstr(":2:9: the file is of format 2, this version reads up to 1; fly"));
  EXPECT_THAT(fault("format: 0\n"), HasSubstr("write 'format: 1'"));
  EXPECT_THAT(fault("format: new\n"), HasSubstr(":1:9: "));
}

class MissionWithBase : public ::testing::Test {
 protected:
  MissionWithBase() {
    fs::create_directories(folder_ / "one");
    fs::create_directories(folder_ / "other");
    write("one/mission.yaml", "name: one\nmodel: a.yaml\nground: {values: [a, b]}\nunits: {x: m}\nspede: 1\n");
  }
  ~MissionWithBase() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string fault(const fs::path& file) const {
    try {
      load_mission_file(file);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_mission_base_" + std::to_string(::getpid()));
};

TEST_F(MissionWithBase, KeysOfTheFileCountAndAllOthersAreThoseOfTheBase) {
  const fs::path file =
      write("other/mission.yaml", "base: ../one/mission.yaml\nname: other\nground: {values: [c]}\nunits:\n");
  const Entry mission = load_mission_file(folder_ / "other");
  EXPECT_EQ(mission.at("name").text(), "other");
  EXPECT_EQ(mission.at("model").text(), "a.yaml");
  EXPECT_EQ(mission.at("ground").at("values").texts(), std::vector<std::string>{"c"}) << "not deeper";
  EXPECT_FALSE(mission.find("units")) << "it stands there with nothing behind it";
  EXPECT_EQ(mission.file(), file);
  std::vector<std::string> keys;
  for (const auto& [key, value] : mission.fields()) keys.push_back(key);
  EXPECT_THAT(keys, ::testing::ElementsAre("base", "name", "ground", "units", "model", "spede"));
}

TEST_F(MissionWithBase, PlacesAndNamesOfFilesBelongToTheFileWhereTheyStand) {
  write("other/mission.yaml", "base: ../one/mission.yaml\nsite: b.yaml\n");
  const Entry mission = load_mission_file(folder_ / "other");
  const Entry model = mission.at("model");
  EXPECT_EQ(fs::weakly_canonical(model.resolve(model.text())), fs::weakly_canonical(folder_ / "one/a.yaml"));
  EXPECT_THAT(model.place(), HasSubstr("one/mission.yaml:2:8"));
  const Entry site = mission.at("site");
  EXPECT_EQ(site.resolve(site.text()), folder_ / "other/b.yaml");
  try {
    mission.allow_only({"base", "name", "model", "ground", "units", "site"});
    FAIL() << "a key of the base is misspelt";
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("one/mission.yaml:5:1: unknown key 'spede'"));
  }
  try {
    mission.at("robots");
    FAIL() << "it stands in neither";
  } catch (const FileError& error) {
    EXPECT_THAT(error.what(), HasSubstr("other/mission.yaml:1:1: 'robots' is missing"));
  }
}

TEST_F(MissionWithBase, ABaseIsAnotherFileThatIsThereAndHasNone) {
  EXPECT_THAT(fault(write("other/a.yaml", "name: a\nbase: b.yaml\n")),
              HasSubstr("other/a.yaml:2:7: there is no base file"));
  write("other/b.yaml", "base: a.yaml\n");
  EXPECT_THAT(fault(folder_ / "other/a.yaml"), HasSubstr("b.yaml:1:7: the base of")) << "a circle of two";
  EXPECT_THAT(fault(write("other/c.yaml", "base: ../other/c.yaml\n")),
              HasSubstr("c.yaml:1:7: the file is a base of itself; name another one"));
  write("other/d.yaml", "base: ../one/mission.yaml\n");
  EXPECT_THAT(fault(write("other/e.yaml", "base: d.yaml\n")), HasSubstr("d.yaml:1:7: the base of"));
  write("other/f.yaml", "format: 2\n");
  EXPECT_THAT(fault(write("other/g.yaml", "base: f.yaml\n")), HasSubstr("f.yaml:1:9: the file is of format 2"));
  EXPECT_THAT(fault(write("other/h.yaml", "base: [f.yaml]\n")), HasSubstr("h.yaml:1:7: expected a single value"));
  EXPECT_THAT(fault(write("other/i.yaml", "base: ..\n")), HasSubstr("there is no base file"));
}

}  // namespace
}  // namespace roci::mission
