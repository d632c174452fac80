// The host of one of the two executives is cut off, or one of them from the robot, which may die while it hands over,
// as the one may to which goals are handed over. Flown live: who is cut off from the simulated clock has lost the run.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenario/cut_pair.hpp"

namespace roci::scenario {
namespace {

class CutHost : public ::testing::TestWithParam<Cut> {};

TEST_P(CutHost, NothingIsLostOrDoneTwice) { expect_nothing_lost(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Cuts, CutHost,
    ::testing::Values(Cut{"first", "mixed", "live 20", "second"}, Cut{"leader", "mixed", "live 4", "second"},
                      Cut{"second", "mixed", "live 20", "first"}, Cut{"robot", "mixed", "live 20", "second"},
                      Cut{"handover", "cyclonedds", "live 20", "second"},
                      Cut{"merging", "mixed", "live 4", "second"}),
    [](const auto& test) { return std::string(test.param.where) + "_" + test.param.dds; });

}  // namespace
}  // namespace roci::scenario
