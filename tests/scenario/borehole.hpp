// Flights of the mission of example_service, whose drill is the SDK's (folder "sdk") or a native participant
// ("native_c", "native_cpp").
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {

std::filesystem::path mission_of(const std::string& drill);

class BoreholeFlight : public ::testing::Test {
 protected:
  BoreholeFlight();
  ~BoreholeFlight() override;

  std::filesystem::path run_folder(const std::string& name) const { return folder / name; }
  // The drill is killed while it bores; its next process takes its place, and the mission goes on with every goal.
  void expect_to_outlive_a_kill(const std::string& drill, const std::string& dds,
                                const std::string& clock) const;

  const std::filesystem::path folder;  // of this test alone
};

}  // namespace roci::scenario
