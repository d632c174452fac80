// The mission of example_service: a user's services on the SDK, and the same drill as native participants in C and C++
// that link no code of ours. Whoever reads the command line,
// the clock and the commands as the pages of docs/ have them gives the same flight.
#include "tests/scenario/borehole.hpp"

#include <gmock/gmock.h>

#include <fstream>

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

class Borehole : public BoreholeFlight, public ::testing::WithParamInterface<const char*> {};

TEST_P(Borehole, HasOneTraceFromTheSdkAndFromNativeParticipants) {
  const fs::path rehearsed = run_folder("rehearsed");
  const Ended rehearsal = run("roci-rehearse " + mission_of("sdk").string() + " --json --run-folder " +
                              rehearsed.string() + " 2>&1");
  ASSERT_EQ(rehearsal.exit_code, 0) << rehearsal.output;
  const json reference = last_line_as_json(rehearsal.output);
  EXPECT_EQ(reference.value("result", ""), "achieved") << rehearsal.output;
  for (const char* drill : {"sdk", "native_c", "native_cpp"}) {
    const fs::path flown = run_folder(drill);
    const Flight flight = fly(mission_of(drill), GetParam(), 1, "--run-folder " + flown.string());
    EXPECT_EQ(flight.exit_code, 0) << drill << flight.summary.dump();
    EXPECT_EQ(flight.summary["expected"].value("fault", "no report"), "") << drill;
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), reference.value("trace_sha256", "none")) << drill;
    const std::string logbook = text_of(flown / "logbook.txt");
    for (const char* word : {"cancelled cancelled to p1.1-bore", "accepted repairing to p2.2-bore",
                             "completed done to p2.2-bore"})
      EXPECT_THAT(logbook, HasSubstr(word)) << drill;
  }
}

INSTANTIATE_TEST_SUITE_P(Transports, Borehole, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& transport) { return std::string(transport.param); });

class BoreholeKill : public BoreholeFlight, public ::testing::WithParamInterface<const char*> {};

TEST_P(BoreholeKill, TheNextProcessOfANativeParticipantInCGoesOn) {
  expect_to_outlive_a_kill("native_c", GetParam(), "simulated");
}

TEST_P(BoreholeKill, TheNextProcessOfANativeParticipantInCppGoesOn) {
  expect_to_outlive_a_kill("native_cpp", GetParam(), "simulated");
}

INSTANTIATE_TEST_SUITE_P(Transports, BoreholeKill, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& transport) { return std::string(transport.param); });

TEST_F(BoreholeFlight, ARehearsalSaysWhatAProgramLacks) {
  const Ended without = run("roci-rehearse " + mission_of("native_c").string() + " 2>&1");
  EXPECT_EQ(without.exit_code, 3) << without.output;
  EXPECT_THAT(without.output, HasSubstr("bin/drill_svc.so: there is no such file"));
  EXPECT_THAT(without.output,
              HasSubstr("build the program with rocinante_service() (docs/sdk.md), or fly with roci-launch"));

  const fs::path mission = folder / "borehole";
  fs::copy(mission_of("sdk"), mission, fs::copy_options::recursive);
  std::ofstream(mission / "bin/drill_svc.so") << "no library";
  EXPECT_THAT(run("roci-rehearse " + mission.string() + " 2>&1").output,
              HasSubstr("drill_svc.so: cannot be loaded: "));
  fs::copy_file(fs::path(ROCI_BINARY_DIR "/lib/rocinante/libroci_transport_inproc.so"),
                mission / "bin/drill_svc.so", fs::copy_options::overwrite_existing);
  EXPECT_THAT(run("roci-rehearse " + mission.string() + " 2>&1").output,
              HasSubstr("drill_svc.so: holds no service; name it with ROCI_SERVICE_PROGRAM"));
  const Ended other =
      run("echo 'const char* roci_service_program[] = {\"roci;build=0.0.0\", \"0\", 0};' | gcc -shared -fPIC "
          "-x c - -o " +
          (mission / "bin/drill_svc.so").string());
  ASSERT_EQ(other.exit_code, 0) << other.output;
  EXPECT_THAT(
      run("roci-rehearse " + mission.string() + " 2>&1").output,
      HasSubstr("drill_svc.so: was built with another Rocinante or another compiler than this program"));
}

// What users copy stands on nothing of ours.
TEST(NativeDrill, IncludesAndLinksNothingOfOurs) {
  for (const auto& entry : fs::recursive_directory_iterator(ROCI_SOURCE_DIR "/example_service/native")) {
    if (!entry.is_regular_file()) continue;
    const std::string text = text_of(entry.path());
    for (const char* ours :
         {"#include \"services/", "#include \"core/", "#include \"roci_idl/", "rocinante::"})
      EXPECT_THAT(text, Not(HasSubstr(ours))) << entry.path();
  }
  for (const auto& [drill, vendor] :
       {std::pair{"native_c", "libddsc"}, std::pair{"native_cpp", "libfastrtps"}}) {
    const std::string program = (mission_of(drill) / "bin/drill_svc").string();
    EXPECT_THAT(run("ldd " + program).output, HasSubstr(vendor));
    EXPECT_EQ(run("nm -C " + program + " | grep -c 'roci::services'").output, "0\n");
  }
}

}  // namespace
}  // namespace roci::scenario
