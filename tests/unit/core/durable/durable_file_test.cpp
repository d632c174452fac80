#include "core/durable/durable_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <sstream>

#include "tests/unit/core/durable/sync_record.hpp"

namespace roci::durable {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class DurableFile : public ::testing::Test {
 protected:
  DurableFile() {
    fs::remove_all(folder);
    fs::create_directories(folder);
    synced().clear();
  }
  ~DurableFile() override { fs::remove_all(folder); }

  std::string text() const {
    std::ostringstream out;
    out << std::ifstream(file).rdbuf();
    return out.str();
  }

  const fs::path folder =
      fs::canonical(fs::temp_directory_path()) / ("roci_durable_" + std::to_string(getpid()));
  const fs::path file = folder / "record";
};

TEST_F(DurableFile, IsOnTheDiskWithItsNameWhenItHasBeenReplaced) {
  std::ofstream(file) << "old";
  replace_file(file, "new");
  EXPECT_EQ(text(), "new");
  EXPECT_THAT(synced(), ElementsAre(file.string() + ".new", folder.string()));
}

TEST_F(DurableFile, IsNotWaitedForWhereItOutlastsItsProcessAlone) {
  replace_file(file, "new", Durability::process);
  EXPECT_EQ(text(), "new");
  EXPECT_THAT(synced(), IsEmpty());
}

TEST_F(DurableFile, HasItsNewNameOnTheDiskWhenItHasBeenPutInPlace) {
  std::ofstream(folder / "made") << "made";
  put_in_place(folder / "made", file);
  EXPECT_EQ(text(), "made");
  EXPECT_FALSE(fs::exists(folder / "made"));
  EXPECT_THAT(synced(), ElementsAre(folder.string()));
}

TEST_F(DurableFile, StaysAsItWasWhereItCannotBeReplaced) {
  std::ofstream(file) << "old";
  EXPECT_THROW(put_in_place(folder / "missing", file), fs::filesystem_error);
  EXPECT_THROW(replace_file(folder / "nowhere" / "record", "new"), std::system_error);
  EXPECT_EQ(text(), "old");
}

TEST_F(DurableFile, HasThePermissionsThatItIsGiven) {
  replace_file(file, "secret", Durability::power, 0600);
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 07777, 0600U);
}

}  // namespace
}  // namespace roci::durable
