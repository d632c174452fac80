// A prefix from which a mission flies, with the source folder hidden.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/scenario/flight.hpp"

namespace roci::scenario {

class Prefix : public ::testing::Test {
 protected:
  Prefix();
  ~Prefix() override;

  // Whether this user may mount an empty folder over the source folder, in a namespace of his own.
  static bool may_hide_the_source();
  // Flies from `prefix` where source and build folder are empty, with nothing of this test's environment, and expects
  // that every goal is achieved.
  void expect_to_fly_from(const std::filesystem::path& prefix) const;
  // Builds example_service, as it was installed, with the SDK of `prefix` alone;
  // launcher and rehearsal fly its mission with one trace.
  void expect_a_users_services_to_fly(const std::filesystem::path& prefix) const;

  const std::filesystem::path folder;  // of this test alone
};

}  // namespace roci::scenario
