#include "pathplan_svc/map_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::pathplan {
namespace {

using testing::HasSubstr;

std::string map_error(const std::string& text) {
  try {
    read_map_settings(mission::Entry::parse(text, "mission.yaml"));
  } catch (const mission::FileError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MapFile, SaysWhenAMapIsTold) {
  EXPECT_EQ(MapSettings{}.sharing, MapSharing::never);
  const MapSettings out =
      read_map_settings(mission::Entry::parse("tell: on_request\nsubsystem: terrain\n", "mission.yaml"));
  EXPECT_EQ(out.sharing, MapSharing::on_request);
  EXPECT_EQ(out.subsystem, "terrain");
  EXPECT_EQ(read_map_settings(mission::Entry::parse("tell: at_once\n", "mission.yaml")).sharing,
            MapSharing::at_once);
}

TEST(MapFile, FaultsNameTheirPlaceAndTheRemedy) {
  EXPECT_THAT(map_error("tell: at_onec\n"),
              HasSubstr("mission.yaml:1:7: a map is told at_once or on_request"));
  EXPECT_THAT(map_error("subsystem: map\n"), HasSubstr("tell"));
  EXPECT_THAT(map_error("tell: at_once\nsubsystem: ''\n"), HasSubstr("mission.yaml:2:"));
  EXPECT_THAT(map_error("tell: at_once\nwhom: all\n"), HasSubstr("unknown key 'whom'"));
}

}  // namespace
}  // namespace roci::pathplan
