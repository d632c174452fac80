// What other users of a host, signals at the wrong moment and a cut power line cannot do to a process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "core/durable/durable_file.hpp"
#include "services/clock/wall.hpp"
#include "services/health/watchdog_notifier.hpp"
#include "services/launch/child.hpp"
#include "services/launch/notify_socket.hpp"
#include "services/process/private_folder.hpp"
#include "services/process/run_record.hpp"
#include "services/process/stop_signals.hpp"

namespace roci::services::process {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr uid_t kSomebodyElse = 54321;

class HostSafety : public testing::Test {
 protected:
  HostSafety() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~HostSafety() override { fs::remove_all(folder); }

  static mode_t mode_of(const fs::path& path) {
    struct stat status {};
    EXPECT_EQ(stat(path.c_str(), &status), 0);
    return status.st_mode & 07777;
  }
  static std::string complaint(void (*make)(const fs::path&), const fs::path& path) {
    try {
      make(path);
      return "";
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_safety_" + std::to_string(::getpid()));
};

TEST_F(HostSafety, AFolderIsMadeForThisUserAlone) {
  make_own_folder(folder / "a" / "run");
  EXPECT_EQ(mode_of(folder / "a" / "run"), 0700U);
  make_own_folder(folder / "a" / "run");
  fs::permissions(folder / "a", fs::perms(0755));
  make_private_folder(folder / "a");
  EXPECT_EQ(mode_of(folder / "a"), 0700U);
}

TEST_F(HostSafety, ALinkInTheFoldersPlaceIsRefused) {
  fs::create_directory(folder / "target");
  fs::create_directory_symlink(folder / "target", folder / "run");
  for (const auto make : {make_own_folder, make_private_folder}) {
    EXPECT_THAT(complaint(make, folder / "run"), HasSubstr("symbolic link"));
    EXPECT_THAT(complaint(make, (folder / "run").string() + "/"), HasSubstr("symbolic link"));
  }
}

TEST_F(HostSafety, AFolderWhereEverybodyMayWriteIsRefused) {
  fs::create_directory(folder / "run");
  fs::permissions(folder / "run", fs::perms(01777));
  EXPECT_THAT(complaint(make_own_folder, folder / "run"), HasSubstr("written by every user"));
}

TEST_F(HostSafety, AFolderOfSomebodyElseIsRefused) {
  fs::create_directory(folder / "run");
  if (chown((folder / "run").c_str(), kSomebodyElse, kSomebodyElse) != 0)
    GTEST_SKIP() << "this user cannot give a folder away";
  for (const auto make : {make_own_folder, make_private_folder})
    EXPECT_THAT(complaint(make, folder / "run"), HasSubstr("belongs to another user"));
}

TEST_F(HostSafety, TheRuntimeFolderOfSomebodyElseIsNotUsed) {
  const std::string before = getenv("XDG_RUNTIME_DIR") == nullptr ? "" : getenv("XDG_RUNTIME_DIR");
  setenv("XDG_RUNTIME_DIR", folder.c_str(), 1);
  EXPECT_EQ(mode_of(runtime_folder()), 0700U);
  fs::remove(folder / "rocinante");
  fs::create_directory(folder / "target");
  fs::create_directory_symlink(folder / "target", folder / "rocinante");
  EXPECT_THROW(runtime_folder(), std::runtime_error);
  before.empty() ? unsetenv("XDG_RUNTIME_DIR") : setenv("XDG_RUNTIME_DIR", before.c_str(), 1);
}

TEST_F(HostSafety, AFileIsReplacedAndALinkOfItsNameNotFollowed) {
  std::ofstream(folder / "precious") << "precious";
  fs::create_symlink(folder / "precious", folder / "record");
  fs::create_symlink(folder / "precious", folder / "record.new");
  durable::replace_file(folder / "record", "text");
  EXPECT_FALSE(fs::is_symlink(folder / "record"));
  EXPECT_EQ(fs::file_size(folder / "record"), 4U);
  EXPECT_EQ(fs::file_size(folder / "precious"), 8U);
  EXPECT_THROW(durable::replace_file(folder / "nowhere" / "record", "text"), std::system_error);
}

TEST_F(HostSafety, TheLogOfAChildIsNoLink) {
  std::ofstream(folder / "precious") << "precious";
  fs::create_symlink(folder / "precious", folder / "log");
  EXPECT_THROW(launch::Child("/bin/true", {"true"}, folder / "log"), std::system_error);
}

TEST_F(HostSafety, TheSupervisorsSocketStandsInItsFolderAndGoesWithIt) {
  {
    launch::NotifySocket socket(folder);
    EXPECT_EQ(socket.address(), (folder / ("notify-" + std::to_string(getpid()))).string());
    health::WatchdogNotifier(socket.address()).notify();
    EXPECT_THAT(socket.receive(), testing::ElementsAre(getpid()));
  }
  EXPECT_TRUE(fs::is_empty(folder));
  const fs::path deep = folder / std::string(120, 'x');
  fs::create_directory(deep);
  EXPECT_TRUE(launch::NotifySocket(deep).address().starts_with("@")) << "no name of a socket is so long";
}

// A signal that comes while what it speaks of is already gone.
TEST(StopSignalsTest, AfterItsWatchNothingIsCalled) {
  StopSignals signals;
  std::atomic<int> stops{0};
  const auto until = [](const std::function<bool()>& so) {
    const auto end = clock::wall_now() + clock::wall_seconds(20);
    while (!so() && clock::wall_now() < end) std::this_thread::yield();
    return so();
  };
  {
    const StopWatch watch(signals, [&stops] { ++stops; });
    kill(getpid(), SIGTERM);
    ASSERT_TRUE(until([&] { return stops == 1; }));
  }
  kill(getpid(), SIGTERM);
  std::atomic<int> later{0};
  ASSERT_TRUE(until([&] {  // it was taken, for nobody
    sigset_t pending;
    sigpending(&pending);
    return sigismember(&pending, SIGTERM) == 0;
  }));
  {
    const StopWatch watch(signals, [&later] { ++later; });
    kill(getpid(), SIGINT);
    ASSERT_TRUE(until([&] { return later > 0; }));
  }
  EXPECT_EQ(stops, 1);
}

}  // namespace
}  // namespace roci::services::process
