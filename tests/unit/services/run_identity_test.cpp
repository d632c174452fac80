#include "services/node/run_identity.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::services::node {
namespace {

using testing::ElementsAre;
using testing::Pair;

TEST(RunIdentity, ASampleOfAnotherRunIsNotObeyedAndIsCounted) {
  RunIdentity run("arm_svc", "sol-12", false);
  EXPECT_TRUE(run.obeys("sol-12", "roci/command"));
  EXPECT_FALSE(run.obeys("sol-11", "roci/command"));
  EXPECT_FALSE(run.obeys("sol-11", "roci/goal"));
  EXPECT_FALSE(run.obeys("", "roci/goal")) << "a sample that names no run belongs to none";
  EXPECT_THAT(run.foreign(), ElementsAre(Pair("", 1U), Pair("sol-11", 2U)));
  EXPECT_EQ(run.name(), "sol-12");
}

TEST(RunIdentity, AnObserverJoinsTheFirstRunThatItHears) {
  RunIdentity run("roci-1", "", true);
  EXPECT_TRUE(run.obeys("sol-12", "roci/heartbeat"));
  EXPECT_EQ(run.name(), "sol-12");
  EXPECT_FALSE(run.obeys("sol-11", "roci/heartbeat"));
}

TEST(RunIdentity, AServiceJoinsNone) {
  RunIdentity run("arm_svc", "", false);
  EXPECT_FALSE(run.obeys("sol-12", "roci/command"));
  EXPECT_TRUE(run.obeys("", "roci/command"));
}

TEST(RunIdentity, RemembersABoundedNumberOfForeignRuns) {
  RunIdentity run("arm_svc", "sol-12", false);
  for (int i = 0; i < 1000; ++i) EXPECT_FALSE(run.obeys("run-" + std::to_string(i), "roci/goal"));
  EXPECT_EQ(run.foreign().size(), RunIdentity::kForeignRuns);
}

}  // namespace
}  // namespace roci::services::node
