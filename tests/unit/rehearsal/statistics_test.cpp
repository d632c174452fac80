#include "rehearsal/statistics.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace roci::rehearsal {
namespace {

namespace fs = std::filesystem;

class StatisticsTest : public ::testing::Test {
 protected:
  ~StatisticsTest() override { fs::remove_all(folder_); }

  void fly(const std::string& effects, const std::string& products, const std::string& result) {
    fs::create_directories(folder_);
    std::ofstream(folder_ / "effects.jsonl") << effects;
    std::ofstream(folder_ / "products.jsonl") << products;
    statistics_.add(folder_, result);
  }

  Statistics statistics_;
  const fs::path folder_ = fs::temp_directory_path() / ("roci_statistics_" + std::to_string(::getpid()));
};

TEST_F(StatisticsTest, AFlightCountsOnceForEachDeedAndForDataThatCameHome) {
  fly("{\"kind\":\"dig\",\"object\":\"near\",\"activity\":\"a#1\"}\n"
      "{\"kind\":\"dig\",\"object\":\"near\",\"activity\":\"a#2\"}\n"
      "{\"kind\":\"send\",\"object\":\"downlink#4.2\",\"activity\":\"downlink#4.2\"}\n",
      "{\"kind\":\"view\",\"fate\":\"stored\"}\n{\"kind\":\"view\",\"fate\":\"received\"}\n", "achieved");
  fly("{\"kind\":\"dig\",\"object\":\"near\",\"activity\":\"a#1\"}\nnot a line\n",
      "{\"kind\":\"view\",\"fate\":\"stored\"}\n", "failed");
  EXPECT_EQ(statistics_.text(),
            "of 2 flights ended: achieved 1, failed 1\nof 2 flights did: dig near 2, send 1\n"
            "of 2 flights brought home: view 1\n");
  EXPECT_EQ(statistics_.json()["done"]["dig near"], 2);
  EXPECT_EQ(statistics_.json()["received"]["view"], 1);
}

TEST_F(StatisticsTest, WhatTheWorldDidNotWriteCountsAsEmpty) {
  statistics_.add(folder_ / "none", "crashed");
  EXPECT_EQ(statistics_.text(), "of 1 flights ended: crashed 1\n");
}

}  // namespace
}  // namespace roci::rehearsal
