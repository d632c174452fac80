// One bad thing is never the end of a mission: each is done to a flight of the programs that users start, on the live clock,
// and the mission reaches its goals all the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "exec_svc/journal/journal.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using exec::journal::Durability;
using exec::journal::Journal;
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
  // A shell function that waits until a file holds a text, for a minute at most.
  static std::string waiting() {
    return "until_it_says() { for i in $(seq 600); do grep -aqs \"$2\" $1 && return 0; sleep 0.1; done; "
           "return 1; }; ";
  }
  std::vector<std::string> events() const {
    std::vector<std::string> out;
    Journal(run_folder / "journal.sqlite", Durability::process)
        .for_each([&](temporal::Time, std::string_view kind, std::string_view text) {
          if (kind == "event") out.emplace_back(text);
        });
    return out;
  }
  static void expect_achieved(const Ended& ended) {
    EXPECT_EQ(ended.exit_code, 0) << ended.output;
    EXPECT_EQ(last_line_as_json(ended.output).value("result", ""), "achieved") << ended.output;
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_endurance_" + std::to_string(::getpid()));
  const fs::path run_folder = folder / "run";
};

// Nobody needs it: the mission goes on, and says so.
TEST_F(Endurance, AHelperThatCannotBeKeptIsMissed) {
  fs::copy(kPlanetary, folder / "planetary", fs::copy_options::recursive);
  std::ostringstream text;
  text << std::ifstream(folder / "planetary/mission.yaml").rdbuf();
  std::string mission = text.str();
  const std::string right = "{name: science_svc, ";
  mission.replace(mission.find(right), right.size(), "{name: science_svc, program: ./dies, ");
  std::ofstream(folder / "planetary/mission.yaml") << mission;
  std::ofstream(folder / "planetary/dies") << "#!/bin/sh\nexit 1\n";
  fs::permissions(folder / "planetary/dies", fs::perms::owner_all);
  const Ended ended = run("timeout 280 " + launch((folder / "planetary").string(), "--headless 2>&1"));
  expect_achieved(ended);
  EXPECT_THAT(ended.output,
              HasSubstr("service.missed: science_svc ended with code 1, the 5th time in a row; the "
                        "mission goes on without it"));
}

// The disk fills up in flight, until the mission says so.
TEST_F(Endurance, AFullDiskIsWaitedOut) {
  const Ended ended = run(
      "mkdir " + run_folder.string() + "; unshare -rm sh -c '" + waiting() +
      "mount -t tmpfs -o size=3m,mode=700 tmpfs " + run_folder.string() + " || exit 77; (" + "timeout 280 " +
      launch(kPlanetary, "--headless") + "; echo $? > " + (folder / "code").string() + ") > " +
      (folder / "out").string() + " 2>&1 & until_it_says " + (run_folder / "journal.sqlite-wal").string() +
      " plan.adopted; dd if=/dev/zero of=" + (run_folder / "fill").string() +
      " bs=64k 2>/dev/null; dd if=/dev/zero of=" + (run_folder / "fill2").string() +
      " bs=1 count=65536 2>/dev/null; until_it_says " + (folder / "out").string() + " journal.waiting; rm " +
      (run_folder / "fill").string() + " " + (run_folder / "fill2").string() + "; wait; cp " +
      (run_folder / "exec_svc.log").string() + " " + folder.string() + "/; cat " + (folder / "out").string() +
      "; exit $(cat " + (folder / "code").string() + ")'");
  if (ended.exit_code == 77) GTEST_SKIP() << "this user cannot mount a small disk (unshare -rm)";
  expect_achieved(ended);
  std::ostringstream log;
  log << std::ifstream(folder / "exec_svc.log").rdbuf();
  EXPECT_THAT(log.str(), HasSubstr("the journal was written after"));
  EXPECT_THAT(ended.output, HasSubstr("journal.waiting"));
}

#ifdef ROCI_FAKETIME
// The system clock is set back by an hour, and later forward by more, while the mission flies.
TEST_F(Endurance, ASystemClockThatIsSetChangesNothing) {
  const std::string set_by = (folder / "time").string();
  const Ended ended = run(
      waiting() + "echo +0 > " + set_by +
      "; (timeout 280 env LD_PRELOAD=" ROCI_FAKETIME " FAKETIME_TIMESTAMP_FILE=" + set_by +
      " FAKETIME_NO_CACHE=1 FAKETIME_DONT_FAKE_MONOTONIC=1 DONT_FAKE_MONOTONIC=1 " + launch(kPlanetary, "") +
      "; echo $? > " + (folder / "code").string() + ") > " + (folder / "out").string() +
      " 2>&1 & until_it_says " + (run_folder / "journal.sqlite-wal").string() + " plan.adopted; echo -1h > " +
      set_by + ".new; mv " + set_by + ".new " + set_by + "; until_it_says " + (folder / "out").string() +
      " clock.set; echo +300 > " + set_by + ".new; mv " + set_by + ".new " + set_by + "; wait; cat " +
      (folder / "out").string() + "; exit $(cat " + (folder / "code").string() + ")");
  expect_achieved(ended);
  EXPECT_THAT(ended.output, AllOf(HasSubstr("clock.set: the system clock of this host was set back by 36"),
                                  HasSubstr("set forward by 39"), Not(HasSubstr("was lost: hung"))));
  EXPECT_LT(last_line_as_json(ended.output).value("wall_s", 1e9), 280);
}
#endif

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
