// One bad thing is never the end of a mission: each is done to a flight of the programs that users start, on the live
// clock, and the mission reaches its goals all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "exec_svc/journal/journal.hpp"
#include "services/process/domain_claim.hpp"
#include "tests/scenario/effects.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kPlanetary[] = ROCI_SOURCE_DIR "/missions/planetary";

class Endurance : public ::testing::Test {
 protected:
  Endurance() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Endurance() override { fs::remove_all(folder); }

  std::string launch(const std::string& mission, const std::string& more) const {
    return "roci-launch " + mission + " --dds cyclonedds --clock live --speed 30 --json --run-folder " +
           run_folder.string() + " " + more;
  }
  // The planetary mission, with this script in the place of science_svc.
  fs::path mission_with_science(const std::string& script) const {
    fs::copy(kPlanetary, folder / "planetary", fs::copy_options::recursive);
    edit(folder / "planetary/mission.yaml", "{name: science_svc, ",
         "{name: science_svc, program: ./science, ");
    std::ofstream(folder / "planetary/science") << script;
    fs::permissions(folder / "planetary/science", fs::perms::owner_all);
    return folder / "planetary";
  }
  // A shell function that waits until a file holds a text, for a minute at most.
  static std::string waiting() {
    return "until_it_says() { for i in $(seq 600); do grep -aqs \"$2\" $1 && return 0; sleep 0.1; done; "
           "return 1; }; ";
  }
  std::vector<std::string> events() const { return journaled_events(run_folder / "journal.sqlite"); }
  static void expect_achieved(const Ended& ended) {
    EXPECT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_EQ(last_line_as_json(ended.output).value("result", ""), "achieved") << ended.output;
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_endurance_" + std::to_string(::getpid()));
  const fs::path run_folder = folder / "run";
};

// Nobody needs it: the mission goes on, and says so.
TEST_F(Endurance, AHelperThatCannotBeKeptIsMissed) {
  const fs::path mission = mission_with_science("#!/bin/sh\nexit 1\n");
  const Ended ended = run("timeout 280 " + launch(mission.string(), "--headless 2>&1"));
  expect_achieved(ended);
  EXPECT_THAT(ended.output,
              HasSubstr("service.missed: science_svc ended with code 1, the 5th time in a row; the "
                        "mission goes on without it"));
}

// It died in flight, and each further start of it ends at once: the simulated clock waits for a while, and goes on.
TEST_F(Endurance, TheSimulatedClockGoesOnWithoutAHelperThatDied) {
  const fs::path mission = mission_with_science(
      "#!/bin/sh\n[ -e started ] && exit 1\n: > started\necho $$ > pid.new\nmv pid.new pid\n"
      "exec ${ROCI_BIN:-" ROCI_BINARY_DIR "/bin}/science_svc \"$@\"\n");
  const Ended ended = run("cd " + folder.string() + "; " + waiting() + "(timeout 280 roci-launch " +
                          mission.string() + " --dds cyclonedds --speed 60 --json --headless --run-folder " +
                          run_folder.string() + "; echo $? > code) > out 2>&1 & " + "until_it_says " +
                          (run_folder / "journal.sqlite-wal").string() +
                          " plan.adopted; kill -9 $(cat pid); wait; cat out; exit $(cat code)");
  expect_achieved(ended);
  EXPECT_THAT(ended.output, HasSubstr("service.missed: science_svc ended with code 1"));
}

// Each of the two has a disk of its own. The one that leads cannot write for longer than ten seconds: it is replaced,
// what was said meanwhile goes to the other, and it joins again when it can write.
TEST_F(Endurance, ALeaderOfAPairWhoseDiskIsFullIsReplaced) {
  const services::process::DomainClaim domain;
  const Ended ended = run("timeout 280 unshare -rm " ROCI_SOURCE_DIR
                          "/tests/scenario/full_disk_pair.sh " ROCI_BINARY_DIR "/bin " +
                          std::string(kPlanetary) + " cyclonedds " + std::to_string(domain.id()));
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot mount a small disk (unshare -rm)";
  auto steps = steps_of(ended.output);
  EXPECT_THAT(steps["replaced"].printed.dump(), HasSubstr("\"leader\":\"second\"")) << ended.output;
  EXPECT_EQ(steps["add"].exit_code, 0);
  EXPECT_THAT(steps["joined"].printed.dump(), HasSubstr("\"standby_ready\":true"));
  EXPECT_EQ(steps["robot"].exit_code, 0) << ended.output;
  EXPECT_EQ(steps["second"].printed["goals"].value("achieved", 0), 4) << ended.output;
  EXPECT_GE(steps["full"].exit_code, 10) << "seconds";
  expect_done_once(steps["effects"].printed);
}

// The disk fills up in flight, and stays so for longer than a launcher waits for who is not heard: the executive goes
// on where it stood, and nobody has killed it.
TEST_F(Endurance, AFullDiskIsWaitedOut) {
  const std::string fill = (run_folder / "fill").string(), out = (folder / "out").string();
  const Ended ended =
      run("mkdir " + run_folder.string() + "; unshare -rm sh -c '" + waiting() +
          "mount -t tmpfs -o size=3m,mode=700 tmpfs " + run_folder.string() + " || exit 77; (" +
          "timeout 280 " + launch(kPlanetary, "--headless") + "; echo $? > " + (folder / "code").string() +
          ") > " + out + " 2>&1 & until_it_says " + (run_folder / "journal.sqlite-wal").string() +
          " plan.adopted; for i in $(seq 180); do dd if=/dev/zero of=" + fill +
          " bs=1024 count=4096 oflag=append conv=notrunc 2>/dev/null; sleep 0.1; done; until_it_says " + out +
          " journal.waiting; rm " + fill + "; wait; cp " + (run_folder / "exec_svc.log").string() + " " +
          (run_folder / "journal.sqlite").string() + " " + folder.string() + "/; cat " + out +
          "; exit $(cat " + (folder / "code").string() + ")'");
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot mount a small disk (unshare -rm)";
  expect_achieved(ended);
  EXPECT_THAT(text_of(folder / "exec_svc.log"), HasSubstr("the journal was written after"));
  EXPECT_THAT(ended.output, AllOf(HasSubstr("journal.waiting"), HasSubstr("disk.full")));
  EXPECT_THAT(journaled_events(folder / "journal.sqlite"),
              Not(::testing::Contains(HasSubstr("executive.resumed"))));
}

#ifdef ROCI_FAKETIME
constexpr char kFaketime[] = ROCI_FAKETIME;
#else
constexpr char kFaketime[] = "";  // it is not installed
#endif

// What follows runs under a clock that is set by the file `time`.
class ClocksThatAreSet : public Endurance {
 protected:
  void SetUp() override {
    if (*kFaketime == '\0')
      GTEST_SKIP() << "there is no libfaketime, by which a clock could be set (apt-get install faketime)";
  }
  std::string set_to(const std::string& offset) const {
    return "echo " + offset + " > " + set_by + ".new; mv " + set_by + ".new " + set_by + "; ";
  }
  // Runs a launcher under that clock; what it prints is appended to `out`.
  std::string under_it(const std::string& launcher) const {
    return "timeout 280 env LD_PRELOAD=" + std::string(kFaketime) + " FAKETIME_TIMESTAMP_FILE=" + set_by +
           " FAKETIME_NO_CACHE=1 FAKETIME_DONT_FAKE_MONOTONIC=1 DONT_FAKE_MONOTONIC=1 " + launcher + " >> " +
           out + " 2>&1 ";
  }

  const std::string set_by = (folder / "time").string(), out = (folder / "out").string();
  const std::string log = (run_folder / "journal.sqlite-wal").string();
};

// The system clock is set back by an hour, and later forward by more, while the mission flies.
TEST_F(ClocksThatAreSet, InFlightChangeNothing) {
  const Ended ended =
      run(waiting() + set_to("+0") + under_it(launch(kPlanetary, "")) + "& pid=$!; until_it_says " + log +
          " plan.adopted; " + set_to("-1h") + "until_it_says " + out + " clock.set; " + set_to("+300") +
          "wait $pid; code=$?; cat " + out + "; exit $code");
  expect_achieved(ended);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("clock.set: the system clock of this host was set back by 36"),
                                  HasSubstr("set forward by 39"), Not(HasSubstr("was lost: hung"))));
  EXPECT_LT(last_line_as_json(ended.output).value("wall_s", 1e9), 280);
}

// The executive dies after the clock was set back by an hour, which is 30 hours of this mission; later, with the clock
// set forward, the launcher does. Whoever comes after them counts mission time on from the same anchor.
TEST_F(ClocksThatAreSet, ChangeNothingForWhatIsStartedAgain) {
  const Ended ended =
      run(waiting() + set_to("+0") + under_it(launch(kPlanetary, "")) + "& pid=$!; until_it_says " + log +
          " plan.adopted; launcher=$(pgrep -P $pid); " + set_to("-1h") + "until_it_says " + out +
          " clock.set; kill -9 $(pgrep -P $launcher exec_svc); until_it_says " + log +
          " executive.resumed; until_it_says " + log + " goal.achieved; " + set_to("+300") +
          "kill -9 $launcher; wait; " + under_it("roci-launch --resume " + run_folder.string() + " --json") +
          "; code=$?; cat " + out + "; exit $code");
  expect_achieved(ended);
  EXPECT_THAT(ended.output, Not(HasSubstr("was lost: hung")));
  std::vector<double> resumed;
  exec::journal::Journal(run_folder / "journal.sqlite", exec::journal::Durability::process)
      .for_each([&](temporal::Time at, std::string_view kind, std::string_view text) {
        if (kind == "event" && text.starts_with("executive.resumed"))
          resumed.push_back(temporal::to_seconds(at));
      });
  ASSERT_EQ(resumed.size(), 2U) << ended.output;
  EXPECT_GT(resumed[0], 0);
  EXPECT_GT(resumed[1], resumed[0]);
  EXPECT_LT(resumed[1], 8400) << "a launcher that had anchored anew would be 9,000 s further";
}

// The launcher is killed, and with it every service; another one goes on with the run.
TEST_F(Endurance, ARunGoesOnWhenItsLauncherWasKilled) {
  const Ended ended = run(waiting() + launch(kPlanetary, "--headless") + " & pid=$!; until_it_says " +
                          (run_folder / "journal.sqlite-wal").string() +
                          " goal.achieved; kill -9 $pid; wait; timeout 280 roci-launch --resume " +
                          run_folder.string() + " --headless --json");
  expect_achieved(ended);
  EXPECT_EQ(last_line_as_json(ended.output)["goals"].value("achieved", 0), 3) << "the first of them before";
  EXPECT_THAT(events(), ::testing::Contains(::testing::StartsWith("executive.resumed")));
}

// The same on a disk that is full just then: it is waited for.
TEST_F(Endurance, ARunGoesOnOnceItsDiskHasRoom) {
  const std::string out = (folder / "out").string(), fill = (run_folder / "fill").string();
  const Ended ended =
      run("mkdir " + run_folder.string() + "; unshare -rm sh -c '" + waiting() +
          "mount -t tmpfs -o size=5m,mode=700 tmpfs " + run_folder.string() + " || exit 77; " +
          launch(kPlanetary, "--headless") + " & pid=$!; until_it_says " +
          (run_folder / "journal.sqlite-wal").string() +
          " plan.adopted; kill -9 $pid; wait; dd if=/dev/zero of=" + fill +
          " bs=64k 2>/dev/null; dd if=/dev/zero of=" + fill +
          " bs=1 oflag=append conv=notrunc 2>/dev/null; (timeout 280 roci-launch --resume " +
          run_folder.string() + " --headless --json; echo $? > " + (folder / "code").string() + ") > " + out +
          " 2>&1 & until_it_says " + out + " \"waits for its disk\"; rm " + fill + "; wait; cat " + out +
          "; exit $(cat " + (folder / "code").string() + ")'");
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot mount a small disk (unshare -rm)";
  EXPECT_THAT(ended.output, HasSubstr("waits for its disk"));
  expect_achieved(ended);
}

}  // namespace
}  // namespace roci::scenario
