// Whatever a disk makes of the networks that the ground sent,
// they are taken as they were written or named as damaged; nothing else comes out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <stdexcept>
#include <string>

#include "planner_svc/limits.hpp"
#include "planner_svc/network_store_service.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
using planner::KeptNetworks, planner::NetworkStage, planner::NetworkStore;

class FuzzNetworkStore : public testing::Test {
 protected:
  FuzzNetworkStore()
      : folder_(fs::temp_directory_path() / ("roci-fuzz-network-store-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    kept_.orders = {{"ground", "first", NetworkStage::refused, "", 0, {"small", 1}, 0, 0, {"too old"}},
                    {"ground", "rate", NetworkStage::in_force, "rate", 2.5, {"small", 2}, 3, 4, {}}};
    store_.keep(kept_, &model_);
  }
  ~FuzzNetworkStore() override { fs::remove_all(folder_); }

  fs::path folder_;
  NetworkStore store_{folder_};
  KeptNetworks kept_;
  std::string model_ = std::string("a network in its binary form: ") + std::string(300, '\x07');
  std::mt19937_64 random_{23};
};

TEST_F(FuzzNetworkStore, WhatWasKeptComesBack) { EXPECT_EQ(store_.load(), kept_); }

TEST_F(FuzzNetworkStore, ADamagedListIsTakenOrNamed) {
  const std::string whole = read_bytes(folder_ / "orders.json");
  for (int round = 0; round < rounds(3000); ++round) {
    const std::string text = damaged(whole, random_);
    write_bytes(folder_ / "orders.json", text);
    try {
      auto taken = store_.load();
      ASSERT_TRUE(taken.has_value());
      store_.keep(*taken);
      ASSERT_EQ(store_.load(), taken) << text;
      write_bytes(folder_ / kept_.model, model_);
    } catch (const std::runtime_error& error) {
      ASSERT_NE(std::string(error.what()).find(folder_.string()), std::string::npos) << error.what();
    }
  }
}

TEST_F(FuzzNetworkStore, ADamagedNetworkIsNeverTaken) {
  for (int round = 0; round < rounds(1000); ++round) {
    const std::string bytes = damaged(model_, random_);
    if (bytes == model_) continue;
    write_bytes(folder_ / kept_.model, bytes);
    ASSERT_THROW(store_.load(), std::runtime_error);
  }
}

TEST_F(FuzzNetworkStore, WhatIsLargerThanAnythingThatIsKeptIsNotReadIntoMemory) {
  fs::resize_file(folder_ / kept_.model, std::uintmax_t{1} << 40U);
  EXPECT_THROW(store_.load(), std::runtime_error);
  fs::resize_file(folder_ / "orders.json", std::uintmax_t{1} << 40U);
  EXPECT_THROW(store_.load(), std::runtime_error);
}

}  // namespace
}  // namespace roci::fuzz
