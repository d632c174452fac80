// A whole run under attack, between real processes: other runs and namesakes on its domain,
// an intruder, a lost journal.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/scenario/attack.hpp"

namespace roci::scenario {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class AttackedRun : public ::testing::TestWithParam<const char*> {};

TEST_P(AttackedRun, GoesOnAndNamesWhoIsNotOfIt) {
  const Ended ended = attack("run_under_attack.sh", GetParam());
  const auto printed = [&](const std::string& step) {
    std::istringstream lines(ended.output);
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with(step + "\t")) return line.substr(step.size() + 1);
    return std::string();
  };
  EXPECT_THAT(printed("another-run"),
              AllOf(HasSubstr("2\t"), HasSubstr("is held by another run, \"attacked\"")));
  EXPECT_THAT(printed("same-run"), AllOf(HasSubstr("2\t"), HasSubstr("run \"attacked\" has a ")));
  EXPECT_THAT(printed("second-executive"),
              AllOf(HasSubstr("2\t"), HasSubstr("this run has another exec_svc")));
  EXPECT_THAT(printed("intruder"), AllOf(HasSubstr("0\t"), HasSubstr("ack y 1000000 rejected epoch-jump")));
  EXPECT_THAT(printed("events"), AllOf(HasSubstr("service.doubled"), HasSubstr("command.epoch_jump"),
                                       HasSubstr("epoch.taken"), Not(HasSubstr("sim_svc was lost"))));
  EXPECT_THAT(printed("launch"), AllOf(HasSubstr("0\t"), HasSubstr("\"result\":\"achieved\"")));
  for (const auto& [effect, count] : effects_by_epoch_in(ended.output)) EXPECT_EQ(count, 1) << effect;
}

INSTANTIATE_TEST_SUITE_P(Transports, AttackedRun, ::testing::Values("fastdds", "cyclonedds"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace roci::scenario
