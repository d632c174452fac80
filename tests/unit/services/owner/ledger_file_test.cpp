#include "services/owner/ledger_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <optional>

#include "tests/unit/core/durable/full_disk.hpp"
#include "tests/unit/core/durable/sync_record.hpp"

namespace roci::services::owner {
namespace {

using testing::ElementsAre;

class LedgerFileTest : public testing::Test {
 protected:
  LedgerFileTest() { std::filesystem::remove(path); }
  ~LedgerFileTest() override { std::filesystem::remove(path); }
  const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("roci_ledger_" + std::to_string(::getpid()));
  const LedgerEntry taken{{"p1.1-drive", 2, "exec_svc", 3}, "exec_svc", 4};
  const LedgerEntry ended{
      {"p1.1-drive", 2, "exec_svc", 3},
      "",
      0,
      CommandStatus{Stage::completed,
                    "done",
                    "at \"wp-2\"\n",
                    {temporal::seconds(7),
                     2.5,
                     {{"ok", true}, {"n", 0.5}, {"at", temporal::state("idle-at", {"wp-2"})}, {"no", {}}}}}};
};

TEST_F(LedgerFileTest, GivesBackWhatWasAppended) {
  {
    LedgerFile file(path);
    EXPECT_THAT(file.read(), testing::IsEmpty());
    file.append(taken);
    file.append(ended);
  }
  LedgerFile again(path);
  EXPECT_THAT(again.read(), ElementsAre(taken, ended));
  again.append(taken);
  EXPECT_EQ(again.read().size(), 3u);
}

TEST_F(LedgerFileTest, ALineThatWasCutShortOrIsNoEntryIsLeftOut) {
  { LedgerFile(path).append(taken); }
  const auto whole = std::filesystem::file_size(path);
  { LedgerFile(path).append(ended); }
  for (auto size = std::filesystem::file_size(path) - 2; size > whole; --size) {
    std::filesystem::resize_file(path, size);
    LedgerFile file(path);
    EXPECT_THAT(file.read(), ElementsAre(taken)) << size;
  }
  std::ofstream(path, std::ios::app) << "{\"word\": 3}\nnull\n{\"commander\":\"a\",\"issued\":-1}\n";
  LedgerFile file(path);
  file.append(ended);
  EXPECT_THAT(file.read(), ElementsAre(taken, ended));
}

// After a loss of power the folder could else have the old file, without what was appended to the new one.
TEST_F(LedgerFileTest, BegunAnewItIsOnTheDiskUnderItsName) {
  LedgerFile file(path);
  file.append(taken);
  durable::synced().clear();
  file.replace({ended});
  EXPECT_THAT(durable::synced(), ElementsAre(path.string() + ".new", path.parent_path().string()));
  file.append(taken);
  EXPECT_THAT(LedgerFile(path).read(), ElementsAre(ended, taken));
}

TEST_F(LedgerFileTest, ATornFileIsOpenedOnAFullDiskAndGoesOnOnceThereIsRoom) {
  { LedgerFile(path).append(taken); }
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 5);
  std::optional<LedgerFile> file;
  {
    const durable::FullDisk full(std::filesystem::file_size(path));
    ASSERT_NO_THROW(file.emplace(path));
    EXPECT_THROW(file->append(ended), std::system_error);
  }
  file->append(ended);
  EXPECT_THAT(file->read(), ElementsAre(ended));
}

TEST_F(LedgerFileTest, AFolderIsNoFile) {
  EXPECT_THROW(LedgerFile(std::filesystem::temp_directory_path()), std::system_error);
}

}  // namespace
}  // namespace roci::services::owner
