// Whole missions, by the programs that users start, under fire: they end as they would have ended, with the same trace.
#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/if_ether.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "services/process/domain_claim.hpp"
#include "tests/contract/support/child_process.hpp"
#include "tests/contract/support/udp_sockets.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::services::contract {
namespace {

namespace fs = std::filesystem;

// ROCI_HOSTILE_DATAGRAMS: how many at least are sent into each flight; the flights go on until they are over.
std::string datagrams(const char* usual) {
  const char* given = std::getenv("ROCI_HOSTILE_DATAGRAMS");
  return given == nullptr ? usual : given;
}

int free_domain() { return process::DomainClaim().id(); }

scenario::Flight fly_in(int domain, const std::string& dds, const std::string& before = "",
                        const std::string& more = " --speed max") {
  scenario::Flight flight;
  const auto ended =
      scenario::run(before + "roci-launch " ROCI_SOURCE_DIR "/missions/planetary --dds " + dds +
                    " --domain " + std::to_string(domain) + " --shared-domain --headless --json" + more);
  flight.exit_code = ended.exit_code;
  flight.summary = scenario::last_line_as_json(ended.output);
  return flight;
}

// Who replays what others say must hear it first (packet(7)).
bool may_listen_to_others() {
  const int heard = socket(AF_PACKET, SOCK_DGRAM | SOCK_CLOEXEC, htons(ETH_P_IP));
  const bool refused = heard < 0 && (errno == EPERM || errno == EACCES);
  if (heard >= 0) close(heard);
  return !refused;
}

int times_in(const std::string& text, const std::string& words) {
  int times = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++times;
  return times;
}

std::vector<std::string> hostile_command(const std::string& role, int domain) {
  return {ROCI_BINARY_DIR "/tests/contract-hostile", role, std::to_string(domain)};
}

class HostileFlight : public testing::TestWithParam<const char*> {
 protected:
  void expect_undisturbed(const scenario::Flight& flight) {
    static std::map<std::string, std::string> traces;
    std::string& undisturbed = traces[GetParam()];
    if (undisturbed.empty())
      undisturbed = scenario::fly(ROCI_SOURCE_DIR "/missions/planetary", GetParam())
                        .summary.value("trace_sha256", "none");
    EXPECT_EQ(flight.exit_code, 0);
    EXPECT_EQ(flight.summary.value("result", ""), "achieved");
    EXPECT_EQ(flight.summary.value("trace_sha256", ""), undisturbed);
  }
};

TEST_P(HostileFlight, MutantsOfItsOwnTrafficChangeNothing) {
  if (!may_listen_to_others())
    GTEST_SKIP() << "this user may not hear what goes over the loopback (CAP_NET_RAW), so that nothing can "
                    "be replayed";
  const int domain = free_domain();
  const std::string seed = "14";
  auto command = hostile_command("inject", domain);
  command.insert(command.end(), {seed, datagrams("10000")});
  ChildProcess injector(command);
  const auto flight = fly_in(domain, GetParam());
  expect_undisturbed(flight);
  EXPECT_TRUE(injector.wait_for("sent " + datagrams("10000") + " " + seed, std::chrono::seconds(1)))
      << "while the mission flew";
}

TEST_P(HostileFlight, AnExecutiveThatIsStartedAnewSurvivesWhatIsLatched) {
  const int domain = free_domain();
  const fs::path folder = fs::temp_directory_path() / ("roci_latched_" + std::to_string(getpid()));
  fs::remove_all(folder);
  ChildProcess writers(hostile_command("writers", domain));
  ASSERT_TRUE(writers.wait_for("round 2", std::chrono::seconds(60)))
      << "all of it stands latched before the flight begins";
  // The third acknowledgement comes at 759 s of 2517: at this pace either process is there for long enough to find the
  // writers, which takes up to a second.
  const auto flight =
      fly_in(domain, GetParam(), "ROCI_CRASH=after-ack:3 ", " --speed 400 --run-folder " + folder.string());
  EXPECT_EQ(flight.exit_code, 0);
  EXPECT_EQ(flight.summary.value("result", ""), "achieved");
  // Both processes of the executive have met the writers. Of what our decoder refuses each tells the first sample of a
  // topic (sample.refused); Cyclone DDS refuses their messages before; of each ten seconds a process tells 20, and
  // then how many more there were.
  const std::string log = scenario::text_of(folder / "exec_svc.log");
  if (std::string(GetParam()) == "fastdds") {
    EXPECT_EQ(
        times_in(log,
                 "exec_svc refuses a sample of roci/goal: it is no sample of the topic's type (1 so far)"),
        2);
  } else {
    EXPECT_GT(times_in(log, "cyclonedds: malformed packet received from vendor"),
              20 * (1 + times_in(log, "lines more")));
  }
  fs::remove_all(folder);
}

TEST_P(HostileFlight, NoProcessOfARunIsBoundToAnotherAddressThanLoopback) {
  const std::string domain = std::to_string(free_domain());
  ChildProcess launcher({ROCI_BINARY_DIR "/bin/roci-launch", ROCI_SOURCE_DIR "/missions/planetary", "--dds",
                         GetParam(), "--domain", domain, "--clock", "live", "--speed", "20", "--headless"});
  ChildProcess console(
      {ROCI_BINARY_DIR "/bin/roci", "--dds", GetParam(), "--domain", domain, "watch", "--json"});
  do {
    ASSERT_TRUE(console.wait_for_more(std::chrono::seconds(60))) << "the flight does not begin";
  } while (console.lines().back().find("\"executing\"") == std::string::npos);
  std::vector<pid_t> processes = processes_below(launcher.pid());
  EXPECT_THAT(processes, testing::SizeIs(testing::Ge(6U))) << "the services of the mission";
  processes.push_back(launcher.pid());
  processes.push_back(console.pid());
  for (const pid_t process : processes)
    EXPECT_THAT(udp_addresses_of(process),
                testing::AllOf(testing::SizeIs(testing::Ge(2U)), testing::Each("127.0.0.1")))
        << scenario::text_of("/proc/" + std::to_string(process) + "/comm");
}

INSTANTIATE_TEST_SUITE_P(Vendors, HostileFlight, testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::services::contract
