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

}  // namespace
}  // namespace roci::mission
