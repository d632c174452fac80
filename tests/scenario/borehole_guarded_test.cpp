// A user's services where more is asked of a run: encrypted, with the rights of the mission's list alone, and with a
// standby that takes over.
#include <gmock/gmock.h>

#include "tests/scenario/borehole.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;

class BoreholeGuarded : public BoreholeFlight, public ::testing::WithParamInterface<const char*> {};

// The keys are made as docs/sdk.md says; the rights of drill and logbook stand in the mission's list.
TEST_P(BoreholeGuarded, FliesEncryptedWithTheRightsOfItsListAlone) {
  const std::string keys = (folder / "keys").string();
  const Ended made = run("roci-keys make " + mission_of("sdk").string() + " --keys " + keys + " 2>&1");
  ASSERT_EQ(made.exit_code, 0) << made.output;
  EXPECT_THAT(made.output, HasSubstr("drill_svc"));
  const fs::path flown = run_folder("secure");
  const Flight secure =
      fly(mission_of("sdk"), GetParam(), 1, "--secure=" + keys + " --run-folder " + flown.string());
  EXPECT_EQ(secure.exit_code, 0) << secure.summary.dump();
  EXPECT_EQ(secure.summary["expected"].value("fault", "no report"), "");
  const Flight plain = fly(mission_of("sdk"), "cyclonedds");
  EXPECT_EQ(secure.summary.value("trace_sha256", "none"), plain.summary.value("trace_sha256", "no trace"));
  for (const char* heard : {"completed done to p2.2-bore", "goal.achieved"})
    EXPECT_THAT(text_of(flown / "logbook.txt"), HasSubstr(heard)) << "the logbook may listen";
}

// The executive that leads dies when the drill's third acknowledgement has come;
// the drill serves the one that takes over.
TEST_P(BoreholeGuarded, GoesOnWithItsStandbyWhenTheExecutiveDies) {
  const Flight alone = fly(mission_of("sdk"), GetParam());
  const fs::path flown = run_folder("pair");
  const Ended ended =
      run("ROCI_CRASH=after-ack:3 roci-launch " + mission_of("sdk").string() + " --dds " + GetParam() +
          " --standby --speed max --headless --json --run-folder " + flown.string());
  const json summary = last_line_as_json(ended.output);
  EXPECT_EQ(ended.exit_code, 0) << ended.output;
  EXPECT_EQ(summary.value("result", ""), "achieved") << ended.output;
  EXPECT_GE(summary.value("epoch", 0), 2) << "it did take over";
  EXPECT_EQ(summary["goals"], alone.summary["goals"]);
  EXPECT_THAT(text_of(flown / "logbook.txt"), HasSubstr("completed done to p2.2-bore"));
}

// What the list does not say, a program of one's own may not do: the keys are not made at all.
TEST_F(BoreholeFlight, KeysForAProgramOfOnesOwnAskForItsRights) {
  const fs::path mission = folder / "borehole";
  fs::copy(mission_of("sdk"), mission, fs::copy_options::recursive);
  edit(mission / "mission.yaml", ", rights: [owner, functions]", "");
  const Ended without =
      run("roci-keys make " + mission.string() + " --keys " + (folder / "keys").string() + " 2>&1");
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_THAT(without.output, HasSubstr("service drill_svc runs a program of its own"));
  EXPECT_THAT(without.output, HasSubstr("e.g. rights: [owner]"));
}

INSTANTIATE_TEST_SUITE_P(Transports, BoreholeGuarded, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& transport) { return std::string(transport.param); });

}  // namespace
}  // namespace roci::scenario
