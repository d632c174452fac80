#include "tests/scenario/borehole.hpp"

#include <gmock/gmock.h>
#include <unistd.h>

namespace roci::scenario {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

fs::path mission_of(const std::string& drill) {
  return fs::path(ROCI_BINARY_DIR "/tests/missions") / drill / "borehole";
}

BoreholeFlight::BoreholeFlight()
    : folder(fs::temp_directory_path() / ("roci_borehole_" + std::to_string(::getpid()))) {
  fs::create_directories(folder);
}

BoreholeFlight::~BoreholeFlight() { fs::remove_all(folder); }

void BoreholeFlight::expect_to_outlive_a_kill(const std::string& drill, const std::string& dds,
                                              const std::string& clock) const {
  const fs::path flown = run_folder("run");
  const std::string speed = clock == "live" ? "60" : "400";
  const Ended ended =
      run("timeout 120 " ROCI_SOURCE_DIR "/tests/scenario/kill_drill.sh " ROCI_BINARY_DIR "/bin " +
          mission_of(drill).string() + " " + dds + " " + flown.string() + " --speed " + speed + " --clock " +
          clock);
  const nlohmann::json summary = last_line_as_json(ended.output);
  ASSERT_EQ(summary.value("result", ""), "achieved") << ended.output << text_of(flown / "logbook.txt");
  EXPECT_EQ(summary["goals"].value("achieved", 0), 2) << ended.output;
  const std::string logbook = text_of(flown / "logbook.txt");
  EXPECT_THAT(logbook, HasSubstr("service.died: drill_svc"));
  EXPECT_THAT(logbook, HasSubstr("drill_svc says completed done"));
}

}  // namespace roci::scenario
