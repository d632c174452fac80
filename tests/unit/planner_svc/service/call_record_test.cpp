// The records of planning calls: the newest ones are kept, however long the mission is.
#include "planner_svc/call_record.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace roci::planner {
namespace {

namespace fs = std::filesystem;

class CallRecordsTest : public testing::Test {
 protected:
  CallRecordsTest() { fs::remove_all(folder); }
  ~CallRecordsTest() override { fs::remove_all(folder); }

  static engine::Answer answer() {
    engine::Answer out = engine::without_plan(temporal::Verdict::unsolvable, "");
    out.record = {{".pddl", "(define)"}, {".values", ""}};
    return out;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }

  const fs::path folder = fs::temp_directory_path() / ("roci_calls_" + std::to_string(::getpid()));
};

TEST_F(CallRecordsTest, TheNewestAreKeptAndNumbersGoOn) {
  constexpr int kKept = static_cast<int>(CallRecords::kKept);
  {
    CallRecords records(folder);
    for (int i = 0; i < kKept + 10; ++i) records.keep(answer(), 0.1);
  }
  std::ofstream(folder / "12-notes.txt") << "somebody else's";
  CallRecords after_a_restart(folder);
  after_a_restart.keep(answer(), 0.1);
  EXPECT_EQ(files(), 3 * CallRecords::kKept + 1);
  EXPECT_FALSE(fs::exists(folder / "11.pddl"));
  EXPECT_TRUE(fs::exists(folder / "12-notes.txt"));
  for (const char* ending : {".json", ".pddl", ".values"}) {
    EXPECT_TRUE(fs::exists(folder / ("12" + std::string(ending))));
    EXPECT_TRUE(fs::exists(folder / (std::to_string(kKept + 11) + ending)));
  }
}

}  // namespace
}  // namespace roci::planner
