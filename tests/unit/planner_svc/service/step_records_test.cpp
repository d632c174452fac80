// What is kept of the steps of an engine that plans all the time, and what goes.
#include "planner_svc/step_records.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <set>

namespace roci::planner {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr, ::testing::UnorderedElementsAre;

class StepRecordsTest : public ::testing::Test {
 protected:
  ~StepRecordsTest() override { fs::remove_all(folder_); }

  std::multiset<std::string> files() const {
    std::multiset<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder_)) out.insert(entry.path().filename().string());
    return out;
  }

  const fs::path folder_ = fs::temp_directory_path() / ("roci_step_records_" + std::to_string(::getpid()));
  const engine::RecordedEngine engine_{"chain", "", {}, "model"};
};

TEST_F(StepRecordsTest, NumbersGoOnAndTheOldestGo) {
  {
    StepRecords before(folder_, {.records = 2});
    before.begin(engine_);
  }
  StepRecords records(folder_, {.records = 2});
  records.begin(engine_);
  EXPECT_THAT(files(), UnorderedElementsAre("1.steps", "2.steps"));
  records.begin(engine_);
  EXPECT_THAT(files(), UnorderedElementsAre("2.steps", "3.steps"));
}

TEST_F(StepRecordsTest, TheOldestGoWhereTheyAreTooLargeTogether) {
  const std::uintmax_t head = engine::record_head(engine_).size();
  StepRecords records(folder_, {.bytes = head, .together = 2 * head});
  for (int i = 0; i < 3; ++i) records.begin(engine_);
  EXPECT_THAT(files(), UnorderedElementsAre("2.steps", "3.steps"));
}

TEST_F(StepRecordsTest, ARecordThatIsFullEndsWithAWholeEntryAndSaysSoOnce) {
  const std::uintmax_t room =
      engine::record_head(engine_).size() + engine::record_entry(engine::StepInputs{}).size();
  StepRecords records(folder_, {.bytes = room + 1});
  records.begin(engine_);
  records.heard({});
  EXPECT_EQ(records.take_end(), "");
  records.heard({});
  EXPECT_THAT(records.take_end(), HasSubstr("1.steps ends here: it has reached"));
  records.did({});
  EXPECT_EQ(records.take_end(), "");
  EXPECT_EQ(fs::file_size(folder_ / "1.steps"), room);
}

TEST_F(StepRecordsTest, NothingIsKeptWithoutAFolder) {
  StepRecords records{fs::path()};
  records.begin(engine_);
  records.heard({});
  EXPECT_EQ(records.take_end(), "");
}

}  // namespace
}  // namespace roci::planner
