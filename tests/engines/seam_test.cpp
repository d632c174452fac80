// What is added for an engine: the table and its own folder. Nobody else knows it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace roci::planner::proof {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Sources of a folder, tests left out, that include a header whose name begins so and are not below it.
std::vector<std::string> who_includes(const std::string& folder, const std::string& header) {
  const fs::path root = ROCI_SOURCE_DIR;
  std::vector<std::string> found;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
    const std::string path = fs::relative(entry.path(), root).string();
    if (!entry.is_regular_file() || path.ends_with("_test.cpp") || path.starts_with(header)) continue;
    std::ostringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    if (text.str().find("#include \"" + header) != std::string::npos) found.push_back(path);
  }
  std::ranges::sort(found);
  return found;
}

TEST(Seam, NothingButTheTableKnowsAnEngine) {
  for (const std::string engine : {"answering", "stepped"})
    EXPECT_THAT(who_includes("tests/engines", "tests/engines/" + engine + "/"),
                ElementsAre("tests/engines/table.cpp"));
}

TEST(Seam, ThePlannerNeedsNoChangeForThem) { EXPECT_THAT(who_includes("planner_svc", "tests/"), IsEmpty()); }

}  // namespace
}  // namespace roci::planner::proof
