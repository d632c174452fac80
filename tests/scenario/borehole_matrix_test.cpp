// Every drill of the mission of example_service, killed while it bores, on every transport and either clock.
#include <tuple>

#include "tests/scenario/borehole.hpp"

namespace roci::scenario {
namespace {

class BoreholeMatrix
    : public BoreholeFlight,
      public ::testing::WithParamInterface<std::tuple<const char*, const char*, const char*>> {};

TEST_P(BoreholeMatrix, EveryGoalIsAchievedByTheNextProcess) {
  const auto [drill, dds, clock] = GetParam();
  expect_to_outlive_a_kill(drill, dds, clock);
}

INSTANTIATE_TEST_SUITE_P(Transports, BoreholeMatrix,
                         ::testing::Combine(::testing::Values("sdk", "native_c", "native_cpp"),
                                            ::testing::Values("fastdds", "cyclonedds", "mixed"),
                                            ::testing::Values("simulated", "live")),
                         [](const auto& flight) {
                           return std::string(std::get<0>(flight.param)) + "_" + std::get<1>(flight.param) +
                                  "_" + std::get<2>(flight.param);
                         });

}  // namespace
}  // namespace roci::scenario
