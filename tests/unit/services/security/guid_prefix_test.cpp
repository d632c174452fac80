// Which GUIDs certificates give, and who may speak with them.
#include "services/certificate/guid_prefix.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace roci::services::certificate {
namespace {

transport::Guid guid_of(const std::string& service, std::string_view vendor) {
  transport::Guid guid{};
  const Start start = start_of(subject_of(service, vendor));
  std::copy(start.begin(), start.end(), guid.begin());
  return guid;
}

// The lower GUID starts the handshake, and Fast DDS must not be it (subject.hpp).
TEST(GuidPrefix, CycloneDdsIsAlwaysBelowFastDds) {
  for (const std::string service :
       {"exec_svc", "planner_svc", "sim_svc", "launcher", "roci", "exec.digger"}) {
    EXPECT_LT(guid_of(service, "cyclonedds"), guid_of("arm_svc", "fastdds")) << service;
    EXPECT_LT(guid_of("arm_svc", "cyclonedds"), guid_of(service, "fastdds")) << service;
    EXPECT_GE(guid_of(service, "cyclonedds")[0], 0x80) << service;
  }
}

TEST(GuidPrefix, AServiceSpeaksForItselfAlone) {
  for (const std::string_view vendor : kVendors) {
    const auto executive = guid_of("exec_svc", vendor), ground = guid_of("roci", vendor);
    EXPECT_TRUE(speaks_as(executive, "exec_svc"));
    EXPECT_TRUE(speaks_as(executive, "exec_svc.second")) << "one of a pair";
    EXPECT_FALSE(speaks_as(executive, "planner_svc"));
    EXPECT_FALSE(speaks_as(executive, ""));
    EXPECT_FALSE(speaks_as(executive, "exec_svc\n"));
    EXPECT_TRUE(speaks_as(ground, "roci-12-1700000000000000")) << "one of many consoles";
    EXPECT_FALSE(speaks_as(executive, "roci-12-1700000000000000"));
  }
}

// As DDS Security makes the last six bytes, first in the way of Cyclone DDS.
TEST(GuidPrefix, ACandidateNamesThePortAndIsLikeNoOther) {
  const Prefix one = candidate_naming(40123, Hashed::prefix), two = candidate_naming(40123, Hashed::prefix);
  EXPECT_NE(one, two);
}

TEST(GuidPrefix, NamesThatNoMissionHasAreRefused) {
  EXPECT_THROW(subject_of("", "fastdds"), std::invalid_argument);
  EXPECT_THROW(subject_of("a,CN=exec_svc", "fastdds"), std::invalid_argument);
  EXPECT_THROW(subject_of(std::string(65, 'a'), "fastdds"), std::invalid_argument);
}

}  // namespace
}  // namespace roci::services::certificate
