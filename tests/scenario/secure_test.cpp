// Secure flights by the programs that users start: the trace is that of a plain one,
// and what cannot be secure does not start.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/contract/secure/key_ring.hpp"
#include "tests/scenario/flight.hpp"
#include "tests/scenario/hung_flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kMission = std::string(ROCI_SOURCE_DIR) + "/missions/planetary";

class SecureFlight : public ::testing::TestWithParam<std::string> {
 protected:
  // As without security, and nothing of ours is taken for a stranger's.
  static void expect_the_plain_trace(const std::string& mission, const std::string& scenario) {
    const services::contract::KeyRing ring(mission);
    const std::string folder = ring.path() + "-run";
    const Flight secure =
        fly(mission, GetParam(), 1,
            "--scenario " + scenario + " --secure=" + ring.path() + " --run-folder " + folder);
    EXPECT_EQ(secure.exit_code, 0) << secure.summary.dump();
    const Flight plain = fly(mission, "inproc", 1, "--scenario " + scenario);
    EXPECT_EQ(secure.summary.value("trace_sha256", "none"), plain.summary.value("trace_sha256", "no trace"));
    const Ended refused = run("cat " + folder + "/*.log | grep -c 'refused before DDS reads them'");
    EXPECT_EQ(refused.output, "0\n");
  }
};

TEST_P(SecureFlight, GivesTheTraceOfThePlainOne) { expect_the_plain_trace(kMission, "nominal"); }

// Dedicated executives are owners, and commanders of what they call (`commander`); two rovers are two sets of rights. A
// scenario may give no orders here, which are the console's alone: the mission's level stands as it is,
// and nobody's rights are widened.
TEST_P(SecureFlight, OfTwoRoversGivesTheTraceOfThePlainOne) {
  const fs::path mission =
      fs::temp_directory_path() / ("roci_secure_faster_" + std::to_string(::getpid())) / "faster";
  fs::create_directories(mission.parent_path());
  fs::copy(ROCI_SOURCE_DIR "/missions/faster", mission, fs::copy_options::recursive);
  edit(mission / "scenarios/trial.yaml", "  - {at_s: 5, order: {id: level, kind: autonomy, level: E3}}",
       "  #");
  expect_the_plain_trace(mission.string(), "trial");
  fs::remove_all(mission.parent_path());
}

INSTANTIATE_TEST_SUITE_P(Transports, SecureFlight, ::testing::Values("fastdds", "cyclonedds", "mixed"),
                         [](const auto& test) { return test.param; });

// Under the simulated clock nothing goes on without who drives it, secure or not;
// what was taken in stands in the journal.
TEST(SecureClock, AMasterThatFallsSilentEndsTheRunAsAPlainOneDoes) {
  const services::contract::KeyRing ring(kMission);
  ::setenv("ROCI_SECURE", ring.path().c_str(), 1);  // for the consoles, too
  expect_ended({"clock", "mixed", "", "sim_svc", ""});
  ::unsetenv("ROCI_SECURE");
}

Ended launch(const std::string& more) {
  return run("timeout 60 roci-launch " + kMission + " --speed max --headless " + more + " 2>&1");
}

TEST(FailClosed, ARunThatCannotBeSecureDoesNotStart) {
  const Ended nowhere = launch("--dds fastdds --secure=/nowhere/keys");
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.output, AllOf(HasSubstr("/nowhere/keys"), HasSubstr("roci-keys make")));
  const Ended one_process = launch("--dds inproc --secure=/nowhere/keys");
  EXPECT_EQ(one_process.exit_code, 2);
  EXPECT_THAT(one_process.output, HasSubstr("inproc"));
  const Ended named = run("ROCI_SECURE=/nowhere/keys timeout 60 roci-launch " + kMission +
                          " --dds cyclonedds --headless 2>&1");
  EXPECT_EQ(named.exit_code, 2);
}

// What the run was started with, and how it ended, stays as it was.
TEST(FailClosed, AResumeThatCannotBeSecureChangesNothing) {
  const fs::path folder = fs::temp_directory_path() / ("roci_refused_" + std::to_string(::getpid()));
  fs::remove_all(folder);
  run("timeout -s KILL 3 roci-launch " + kMission + " --dds fastdds --clock live --headless --run-folder " +
      folder.string() + " 2>&1");
  const auto text_of = [&](const char* file) {
    std::ifstream in(folder / file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string begun = text_of("launch.json");
  ASSERT_THAT(begun, HasSubstr("--run-folder"));
  std::ofstream(folder / "summary.json") << "{}";
  const Ended refused =
      run("timeout 60 roci-launch --resume " + folder.string() + " --secure=/nowhere/keys 2>&1");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.output, HasSubstr("/nowhere/keys"));
  EXPECT_EQ(text_of("launch.json"), begun);
  EXPECT_EQ(text_of("summary.json"), "{}");
  fs::remove_all(folder);
}

TEST(FailClosed, AServiceWithoutAValidCertificateDoesNotStart) {
  const services::contract::KeyRing ring;
  constexpr std::int64_t kDay = 24 * 3600;
  const std::int64_t now = services::contract::KeyRing::now_s();
  ring.authority().renew("arm_svc", 1, now - 10 * kDay);
  ring.authority().revoke("pathplan_svc", "", now);
  const auto start = [&](const std::string& service) {
    return run("timeout 60 " + service + " --mission " + kMission +
               " --dds cyclonedds --domain 77 --secure=" + ring.path() + " 2>&1");
  };
  const Ended expired = start("arm_svc"), revoked = start("pathplan_svc");
  EXPECT_EQ(expired.exit_code, 2);
  EXPECT_THAT(expired.output, AllOf(HasSubstr("ran out on"), HasSubstr("roci-keys renew arm_svc")));
  EXPECT_EQ(revoked.exit_code, 2);
  EXPECT_THAT(revoked.output, HasSubstr("was revoked"));
  const Ended whole = launch("--dds mixed --secure=" + ring.path());
  EXPECT_EQ(whole.exit_code, 2) << "before anything starts";
}

// The vendors would find it when the run has begun.
TEST(FailClosed, AServiceWithTheDocumentsOfAnotherDoesNotStart) {
  const services::contract::KeyRing ring, other;
  const auto put = [](const fs::path& from, const fs::path& to) {
    fs::copy_file(from, to, fs::copy_options::overwrite_existing);
  };
  const fs::path keys = ring.path();
  put(keys / "services/arm_svc/fastdds.permissions.p7s", keys / "services/exec_svc/fastdds.permissions.p7s");
  const Ended permissions = launch("--dds fastdds --secure=" + ring.path());
  EXPECT_EQ(permissions.exit_code, 2);
  EXPECT_THAT(permissions.output, HasSubstr("does not hold the permissions of exec_svc"));
  put(other.path() + "/revoked.pem", keys / "revoked.pem");
  const Ended revoked = launch("--dds cyclonedds --secure=" + ring.path());
  EXPECT_EQ(revoked.exit_code, 2);
  EXPECT_THAT(revoked.output, HasSubstr("revoked.pem is not from the authority"));
}

TEST(Keys, TheProgramMakesListsRenewsAndRevokes) {
  const services::contract::KeyRing other;  // its folder goes, and what stands beside it with it
  const std::string keys = " --keys " + other.path() + "-made 2>&1";
  const Ended made = run("roci-keys make " + kMission + keys);
  EXPECT_EQ(made.exit_code, 0) << made.output;
  EXPECT_THAT(made.output, AllOf(HasSubstr("exec_svc"), HasSubstr("launcher"), HasSubstr("roci")));
  EXPECT_EQ(run("roci-keys list" + keys).exit_code, 0);
  EXPECT_EQ(run("roci-keys revoke arm_svc" + keys).exit_code, 0);
  const Ended listed = run("roci-keys list" + keys);
  EXPECT_EQ(listed.exit_code, 1);
  EXPECT_THAT(listed.output, HasSubstr("arm_svc, cyclonedds: revoked on 20"));
  EXPECT_EQ(run("roci-keys renew arm_svc" + keys).exit_code, 0);
  EXPECT_EQ(run("roci-keys list" + keys).exit_code, 0);
  const Ended unknown = run("roci-keys renew nobody" + keys);
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.output, HasSubstr("knows no nobody"));
  EXPECT_EQ(run("roci-keys --help").exit_code, 0);
  EXPECT_EQ(run("roci-keys").exit_code, 2);
}

}  // namespace
}  // namespace roci::scenario
