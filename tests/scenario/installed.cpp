#include "tests/scenario/installed.hpp"

#include <unistd.h>

#include <map>

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

void Prefix::expect_a_users_services_to_fly(const fs::path& prefix) const {
  const std::string source = (prefix / "share/rocinante/example_service").string();
  const std::string build = (folder / "example").string();
  const Ended built =
      run("cd / && cmake -S " + source + " -B " + build + " -DCMAKE_PREFIX_PATH=" + prefix.string() +
          " -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 2>&1 && cmake --build " + build +
          " --parallel 2 2>&1");
  ASSERT_EQ(built.exit_code, 0) << built.output;
  EXPECT_EQ(run("grep -rl " ROCI_SOURCE_DIR " " + (prefix / "lib/cmake").string() + " " + build +
                " --include=*.cmake --include=*.make")
                .output,
            "")
      << "the SDK names the source folder";
  std::map<std::string, std::string> traces;
  for (const char* program : {"roci-launch", "roci-rehearse"}) {
    const Ended flight = run("cd / && " + (prefix / "bin" / program).string() + " " + build +
                             "/mission --speed max --json --run-folder " + (folder / program).string());
    EXPECT_EQ(flight.exit_code, 0) << program << flight.output;
    traces[program] = last_line_as_json(flight.output).value("trace_sha256", program);
  }
  EXPECT_EQ(traces["roci-launch"], traces["roci-rehearse"]);
}

}  // namespace roci::scenario
