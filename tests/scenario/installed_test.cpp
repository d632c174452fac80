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

// CMake's own list of what it installed, and what ctest and the field trials write meanwhile, are left out: of the
// build folder's own entries these alone, and nothing that is built.
bool is_written_by_others(const fs::path& path) {
  const std::string name = path.lexically_relative(ROCI_BINARY_DIR);
  return name == "install_manifest.txt" || name == "Testing" || name == ".ninja_lock" ||
         name.starts_with("tests/field_trial") || name.starts_with("tests/campaign");
}

std::map<std::string, fs::file_time_type> build_tree() {
  std::map<std::string, fs::file_time_type> out;
  for (fs::recursive_directory_iterator entry(ROCI_BINARY_DIR), end; entry != end; ++entry) {
    if (is_written_by_others(entry->path())) {
      entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      out[entry->path()] = entry->last_write_time();
    }
  }
  return out;
}

// As systemd reads it, with the launcher that was installed beside it; 77: there is no systemd here.
void expect_sound_units(const fs::path& folder) {
  const Ended judged = run("python3 " ROCI_SOURCE_DIR "/tests/unit/services/systemd_units_test.py " +
                           folder.string() + " 2>&1");
  EXPECT_TRUE(judged.exit_code == 0 || judged.exit_code == 77) << judged.output;
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
  expect_sound_units(folder / "first/lib/systemd/user");
  EXPECT_TRUE(fs::exists(folder / "first/bin/roci-check"));
  EXPECT_FALSE(fs::exists(folder / "first/bin/roci-bench-limited")) << "a tool of the benches";

  fs::rename(folder / "first", folder / "moved");
  expect_a_users_services_to_fly(folder / "moved");
  if (!may_hide_the_source()) GTEST_SKIP() << "this user cannot hide the source folder (unshare -rm)";
  expect_to_fly_from(folder / "moved");
}

}  // namespace
}  // namespace roci::scenario
