// The link between the two executives is cut, while both hear the robot.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenario/cut_pair.hpp"

namespace roci::scenario {
namespace {

class CutLink : public ::testing::TestWithParam<Cut> {};

TEST_P(CutLink, NothingIsLostOrDoneTwice) { expect_nothing_lost(GetParam()); }

INSTANTIATE_TEST_SUITE_P(Cuts, CutLink,
                         ::testing::Values(Cut{"between", "cyclonedds", "simulated 400", "first"},
                                           Cut{"between", "mixed", "simulated 400", "first"}),
                         [](const auto& test) {
                           return std::string(test.param.where) + "_" + test.param.dds;
                         });

}  // namespace
}  // namespace roci::scenario
