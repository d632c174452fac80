#include "tests/scenario/installed.hpp"

#include <unistd.h>

namespace roci::scenario {

namespace fs = std::filesystem;

Prefix::Prefix() : folder(fs::temp_directory_path() / ("roci_prefix_" + std::to_string(::getpid()))) {
  fs::remove_all(folder);
  fs::create_directories(folder);
}

Prefix::~Prefix() { fs::remove_all(folder); }

bool Prefix::may_hide_the_source() {
  return run("unshare -rm mount -t tmpfs none " ROCI_SOURCE_DIR " 2>&1").exit_code == 0;
}

void Prefix::expect_to_fly_from(const fs::path& prefix) const {
  const Ended flight =
      run("cd / && unshare -rm sh -c 'mount -t tmpfs none " ROCI_SOURCE_DIR " && exec env -i HOME=" +
          folder.string() + " PATH=/usr/bin:/bin " + (prefix / "bin/roci-launch").string() +
          " planetary --speed max --headless --json --run-folder " + (folder / "run").string() + "' 2>&1");
  EXPECT_EQ(flight.exit_code, 0) << flight.output;
  EXPECT_EQ(last_line_as_json(flight.output).value("result", ""), "achieved") << flight.output;
}

}  // namespace roci::scenario
