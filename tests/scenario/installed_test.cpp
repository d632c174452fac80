// What `cmake --install` writes stands alone: it is moved, the source folder is gone, and a mission flies from it.
#include "tests/scenario/installed.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <map>
#include <sstream>

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// What tests that run meanwhile write, and CMake's own list of what it installed, are left out.
std::map<std::string, fs::file_time_type> build_tree() {
  std::map<std::string, fs::file_time_type> out;
  for (fs::recursive_directory_iterator entry(ROCI_BINARY_DIR), end; entry != end; ++entry) {
    const std::string name = entry->path().filename();
    if (name == "Testing" || name == "tests") entry.disable_recursion_pending();
    if (entry->is_regular_file() && name != "install_manifest.txt")
      out[entry->path()] = entry->last_write_time();
  }
  return out;
}

class Installed : public Prefix {};

TEST_F(Installed, FliesFromAFolderThatWasMoved) {
  const auto before = build_tree();
  const Ended installed =
      run("cmake --install " ROCI_BINARY_DIR " --prefix " + (folder / "first").string() + " 2>&1");
  ASSERT_EQ(installed.exit_code, 0) << installed.output;
  std::vector<std::string> written;
  for (const auto& [file, time] : build_tree())
    if (!before.contains(file) || before.at(file) != time) written.push_back(file);
  EXPECT_THAT(written, IsEmpty());

  std::ostringstream unit;
  unit << std::ifstream(folder / "first/lib/systemd/user/rocinante@.service").rdbuf();
  EXPECT_THAT(unit.str(), HasSubstr("ExecStart=" + (folder / "first/bin/roci-launch").string() + " "));
  EXPECT_TRUE(fs::exists(folder / "first/bin/roci-check"));
  EXPECT_FALSE(fs::exists(folder / "first/bin/roci-bench-limited")) << "a tool of the benches";

  fs::rename(folder / "first", folder / "moved");
  expect_a_users_services_to_fly(folder / "moved");
  if (!may_hide_the_source()) GTEST_SKIP() << "this user cannot hide the source folder (unshare -rm)";
  expect_to_fly_from(folder / "moved");
}

}  // namespace
}  // namespace roci::scenario
