// Whoever adds a reader of files gives it an entry in file_readers.hpp,
// and with that a test that damages what it reads.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/files/file_readers.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ROCI_SOURCE_DIR;

std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool opens_a_file(const std::string& source) {
  return std::ranges::any_of(
      std::array{"std::ifstream", "YAML::LoadFile", "sqlite3_open", "fopen(", "std::fstream"},
      [&](const char* opens) { return source.find(opens) != std::string::npos; });
}

std::string all_tests() {
  std::string text;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests/fuzz"))
    if (entry.path().extension() == ".cpp") text += read(entry.path());
  return text;
}

TEST(FuzzCoverage, EveryReaderOfFilesHasItsTest) {
  for (const char* folder : {"core", "services", "planner_svc", "exec_svc", "pathplan_svc", "dedicated_svc",
                             "arm_svc", "science_svc", "sim_svc", "ground_console", "rehearsal"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp" || !opens_a_file(read(entry.path()))) continue;
      const std::string path = fs::relative(entry.path(), kRoot).string();
      EXPECT_TRUE(kFileReaders.contains(path))
          << path
          << " opens a file: give it a test in tests/fuzz and an entry in tests/fuzz/files/file_readers.hpp";
    }
  }
}

TEST(FuzzCoverage, TheTestsThatAreNamedExist) {
  const std::string tests = all_tests();
  for (const auto& [path, test] : kFileReaders) {
    EXPECT_TRUE(fs::exists(kRoot / path)) << path << " is gone";
    if (test.starts_with("- ")) continue;
    const std::string suite = test.substr(0, test.find('.')), name = test.substr(test.find('.') + 1);
    EXPECT_NE(tests.find("(" + suite + ", " + name + ")"), std::string::npos) << test << ", for " << path;
  }
}

}  // namespace
}  // namespace roci::fuzz
