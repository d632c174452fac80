// The Debian package: apt installs what it needs on a Debian that has nothing yet, its unit starts what it brings,
// and a mission flies from it.
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <memory>

#include "tests/scenario/installed.hpp"

namespace roci::scenario {
namespace {

using ::testing::ContainsRegex;
using ::testing::HasSubstr;

class Packaged : public Prefix {
 protected:
  // The package is made once for all tests.
  static void SetUpTestSuite() {
    made_ = std::make_unique<Made>();
    const Ended packed = run("cd " ROCI_BINARY_DIR " && cpack -B " + made_->folder.string() + " 2>&1");
    ASSERT_EQ(packed.exit_code, 0) << packed.output;
  }
  static void TearDownTestSuite() { made_.reset(); }

  static std::string package() { return (made_->folder / "rocinante_*.deb").string(); }
  std::filesystem::path unpacked() const {
    EXPECT_EQ(run("dpkg-deb -x " + package() + " " + (folder / "root").string()).exit_code, 0);
    return folder / "root";
  }

 private:
  struct Made {
    Made() { std::filesystem::create_directories(folder); }
    ~Made() { std::filesystem::remove_all(folder); }
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("roci_package_" + std::to_string(::getpid()));
  };
  static inline std::unique_ptr<Made> made_;
};

// apt plans the installation for a machine without any package, from the lists that this one has.
TEST_F(Packaged, CanBeInstalledOnADebianThatHasNothing) {
  std::ofstream(folder / "nothing_installed");
  const std::string bare = " -o Dir::State::status=" + (folder / "nothing_installed").string() + " ";
  if (run("apt-get" + bare + "install --simulate libc6 2>&1").exit_code != 0)
    GTEST_SKIP() << "there are no package lists here (apt-get update fetches them)";
  const Ended planned =
      run("cp " + package() + " " + (folder / "rocinante.deb").string() + " && apt-get" + bare +
          "install --simulate --no-install-recommends " + (folder / "rocinante.deb").string() + " 2>&1");
  EXPECT_EQ(planned.exit_code, 0) << planned.output;
  for (const char* needed : {"rocinante", "libfastrtps", "libddsc", "libompl", "libc6"})
    EXPECT_THAT(planned.output, ContainsRegex("\nInst " + std::string(needed))) << needed;
}

TEST_F(Packaged, HasAUnitThatStartsItsOwnLauncher) {
  const auto root = unpacked();
  EXPECT_THAT(text_of(root / "usr/lib/systemd/user/rocinante@.service"),
              HasSubstr("\nExecStart=/usr/bin/roci-launch "));
  EXPECT_TRUE(std::filesystem::exists(root / "usr/bin/roci-launch"));
}

TEST_F(Packaged, FliesWhereItIsUnpacked) {
  const auto root = unpacked();
  if (!may_hide_the_source()) GTEST_SKIP() << "this user cannot hide the source folder (unshare -rm)";
  expect_to_fly_from(root / "usr");
}

}  // namespace
}  // namespace roci::scenario
