// The file of a member's term, on a disk that damages it or is full.
#include "exec_svc/standby/persisted_term_file.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tests/unit/core/durable/full_disk.hpp"

namespace roci::exec::standby {
namespace {

namespace fs = std::filesystem;
using journal::DiskError;
using journal::Durability;
using journal::JournalError;

class PersistedTermFileTest : public ::testing::Test {
 protected:
  PersistedTermFileTest() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~PersistedTermFileTest() override { fs::remove_all(folder); }

  PersistedTerm read() const { return PersistedTermFile(file, Durability::process).read(); }

  const fs::path folder =
      fs::temp_directory_path() / ("roci_term_" + std::to_string(::getpid()) + "_" +
                                   ::testing::UnitTest::GetInstance()->current_test_info()->name());
  const fs::path file = folder / "standing";
};

TEST_F(PersistedTermFileTest, WhatIsKeptIsRead) {
  const PersistedTerm term{7, true, 4};
  PersistedTermFile(file, Durability::power).keep(term);
  EXPECT_EQ(read(), term);
}

TEST_F(PersistedTermFileTest, OneThatIsDamagedIsKeptAndItsMemberIsInDoubt) {
  std::ofstream(file) << "\x01 7 no term";
  PersistedTermFile term(file, Durability::process);
  EXPECT_THROW(term.read(), JournalError);
  const journal::Position newest{7, 50};
  EXPECT_EQ(term.begin_anew(newest), fs::path(file).concat(".damaged-1"));
  EXPECT_TRUE(fs::exists(fs::path(file).concat(".damaged-1")));
  Epochs epochs(Member::first, read());
  const std::uint64_t next = epochs.next(false);
  EXPECT_GT(next, 100U);
  EXPECT_TRUE(epochs.lead(next, newest, false)) << "it may have led since, and does not know";
}

TEST_F(PersistedTermFileTest, NoDamageOfOneCharacterIsTakenForAnotherTerm) {
  PersistedTermFile(file, Durability::process).keep({107, true, 4});
  std::string whole;
  std::getline(std::ifstream(file), whole);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const char put : {'0', '1', '2', '7', ' ', '-'}) {
      if (whole[at] == put) continue;
      std::string damaged = whole;
      damaged[at] = put;
      std::ofstream(file) << damaged;
      EXPECT_THROW(read(), JournalError) << damaged;
    }
    std::ofstream(file) << whole.substr(0, at);
    EXPECT_THROW(read(), JournalError) << whole.substr(0, at);
  }
}

TEST_F(PersistedTermFileTest, AFullDiskIsWaitedFor) {
  PersistedTermFile term(file, Durability::process);
  term.keep({1, false, 0});
  const durable::FullDisk full(0);
  EXPECT_THROW(term.keep({3, true, 2}), DiskError);
  EXPECT_EQ(read(), (PersistedTerm{1, false, 0}));
  int waits = 0, overs = 0;
  term.wait_for_disk({[&](const std::string&) {
                        if (++waits == 3) full.end();
                      },
                      [&] { ++overs; }});
  term.keep({3, true, 2});
  EXPECT_EQ(waits, 3);
  EXPECT_EQ(overs, 1);
  EXPECT_EQ(read(), (PersistedTerm{3, true, 2}));
}

}  // namespace
}  // namespace roci::exec::standby
