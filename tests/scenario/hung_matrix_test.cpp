// Every service alone, on every transport: it hangs and goes on, hangs for ever, or (the pair of executives)
// dies.
#include <gtest/gtest.h>

#include <vector>

#include "tests/scenario/hung_flight.hpp"

namespace roci::scenario {
namespace {

std::vector<Hang> hangs() {
  static constexpr char kPair[] = "--speed 500 --watchdog 4 --standby";
  static constexpr char kLive[] = "--clock live --speed 100 --watchdog 8";
  std::vector<Hang> out;
  for (const char* dds : {"fastdds", "cyclonedds", "mixed"}) {
    for (const char* service : {"planner_svc", "pathplan_svc", "arm_svc", "science_svc"})
      out.push_back({service, dds, service, "", ""});
    out.push_back({"planner_for_ever", dds, "", "planner_svc", ""});
    out.push_back({"pathplan_for_ever", dds, "", "pathplan_svc", ""});
    out.push_back({"arm_for_ever", dds, "", "arm_svc", ""});
    out.push_back({"science_for_ever", dds, "", "science_svc", ""});
    out.push_back({"executive_for_ever", dds, "", "exec_svc", ""});
    out.push_back({"pair_for_ever", dds, "", "exec_svc", "", kPair});
    out.push_back({"pair_killed", dds, "", "", "exec_svc", kPair});
    out.push_back({"robot", dds, "sim_svc", "", "", kLive});
    out.push_back({"planner_live", dds, "planner_svc", "", "", kLive});
  }
  return out;
}

class Hangs : public ::testing::TestWithParam<Hang> {};

TEST_P(Hangs, NothingIsLost) { expect_achieved(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Matrix, Hangs, ::testing::ValuesIn(hangs()),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace roci::scenario
