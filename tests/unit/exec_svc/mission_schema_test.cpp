// docs/formats.md publishes the form of mission.yaml: its table is what the readers know, and a file of a format
// that was left behind is read or refused in words.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr char kPlanetary[] = ROCI_SOURCE_DIR "/missions/planetary";

// Section and where an unknown key is planted in the planetary mission.
struct Section {
  const char* name;
  const char* before;  // a place in the file after which a key of the section may stand
  const char* planted;
};

const Section kSections[] = {
    {"services[]", "{name: arm_svc", ", zz: 1"},
    {"objects[]", "{name: here", ", zz: 1"},
    {"components[]", "  - name: nav\n", "    zz: 1\n"},
    {"components[].lost", "  - name: nav\n", "    lost: {for_s: 60, as: [idle-at], zz: 1}\n"},
    {"components[].states.*", "going-to: {active: true", ", zz: 1"},
    {"families[]", "  - timeline: rover.image.*\n", "    zz: 1\n"},
    {"fluents[]", "{fluent: \"(battery)\"", ", zz: 1"},
    {"windows[]", "  - fact: \"(comm-window)\"\n", "    zz: 1\n"},
    {"actions.*", "drive: {owner: sim_svc", ", zz: 1"},
    {"contingencies.*", "name: planetary\n", "contingencies: {c: {commands: [], zz: 1}}\n"},
    {"goal_kinds.*", "    help: take an image at a place and send it in a communication window\n",
     "    zz: 1\n"},
    {"goal_kinds.*.achieved", "goal: [\"(sent image-{id})\"]", "\n    achieved: {timeline: a, zz: 1}"},
    {"planner.budget", "budget: {work: 4000", ", zz: 1"},
    {"executive", "executive:\n", "  zz: 1\n"},
};

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::vector<std::string> words(std::string text) {
  for (char& c : text)
    if (c == ',' || c == '`') c = ' ';
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

// Section → keys, as docs/formats.md says.
std::map<std::string, std::vector<std::string>> published() {
  std::map<std::string, std::vector<std::string>> out;
  std::istringstream lines(text_of(ROCI_SOURCE_DIR "/docs/formats.md"));
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("## ")) inside = line.starts_with("## Mission file");
    const auto bar = line.find("| `", 3);
    if (!inside || !line.starts_with("| `") || bar == std::string::npos) continue;
    out[words(line.substr(2, bar - 2)).front()] = words(line.substr(bar + 2, line.rfind('|') - bar - 2));
  }
  return out;
}

class MissionSchema : public ::testing::Test {
 protected:
  MissionSchema() { fs::copy(kPlanetary, folder_, fs::copy_options::recursive); }
  ~MissionSchema() override { fs::remove_all(folder_); }

  // What the readers say of the file.
  std::string complaint(const std::string& text) const {
    std::ofstream(folder_ / "mission.yaml") << text;
    try {
      roci::mission::load_service_list(folder_);
      mission::read_mission(folder_);
    } catch (const roci::mission::FileError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_ = fs::temp_directory_path() / ("roci_schema_" + std::to_string(::getpid()));
};

TEST_F(MissionSchema, TheTableIsWhatTheReadersKnow) {
  const auto table = published();
  EXPECT_EQ(table.size(), std::size(kSections)) << "a row for each section, a section for each row";
  for (const Section& section : kSections) {
    std::string text = text_of(fs::path(kPlanetary) / "mission.yaml");
    const auto at = text.find(section.before);
    ASSERT_NE(at, std::string::npos) << section.name;
    text.insert(at + std::string(section.before).size(), section.planted);
    const std::string told = complaint(text);
    ASSERT_THAT(told, HasSubstr("unknown key 'zz'; known here: ")) << section.name;
    const std::string known = told.substr(told.find("known here: ") + 12);
    ASSERT_TRUE(table.contains(section.name)) << section.name;
    EXPECT_EQ(table.at(section.name), words(known)) << section.name;
  }
}

TEST_F(MissionSchema, ANewerFormatIsRefusedInWords) {
  const std::string newer = std::to_string(roci::mission::kMissionFormat + 1);
  std::string text = text_of(fs::path(kPlanetary) / "mission.yaml");
  const std::string stated = "format: " + std::to_string(roci::mission::kMissionFormat);
  ASSERT_THAT(text, HasSubstr(stated));
  text.replace(text.find(stated), stated.size(), "format: " + newer);
  EXPECT_THAT(complaint(text), HasSubstr("mission.yaml:3:9: the file is of format " + newer));
}

// Baseline-05 stated no format and knew no services: what it said of the mission is still read, and what is
// missing since is asked for.
TEST_F(MissionSchema, TheMissionOfBaseline05IsReadAndItsServicesAskedFor) {
  const std::string old = text_of(ROCI_SOURCE_DIR "/tests/unit/exec_svc/golden/mission-1.yaml");
  EXPECT_THAT(complaint(old), HasSubstr("the mission names no services; add for example"));
  const mission::MissionModel mission = mission::read_mission(folder_);
  EXPECT_EQ(mission.actions.size(), 6U);
  EXPECT_EQ(mission.components.size(), 5U);
  EXPECT_EQ(mission.goal_kinds.size(), 3U);
}

}  // namespace
}  // namespace roci::exec
