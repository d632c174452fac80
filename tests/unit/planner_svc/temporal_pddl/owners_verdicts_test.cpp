// What owners of functions say against a place: who, on which map, and whether it is proved.
#include "planner_svc/temporal_pddl/adapter/owners_verdicts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace roci::planner::temporal_pddl::adapter {
namespace {

using engine::FunctionOutcome, engine::FunctionUse;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

FunctionUse use(const std::string& from, const std::string& to, FunctionOutcome outcome) {
  return {{"pathplan", "traverse_time", {from, to}}, {outcome, 7, {"pathplan_svc", "3", {}}, ""}};
}

std::string words(const std::vector<FunctionUse>& uses) {
  const std::vector<engine::Object> objects{{"cliff", "location", {{"x", "190.000"}, {"y", "60"}}}};
  return words_against({"(seen cliff)"}, {}, objects, uses).text;
}

TEST(OwnersVerdicts, NameThePlaceTheOwnerAndItsMap) {
  EXPECT_EQ(words({use("here", "cliff", FunctionOutcome::unreachable),
                   use("b", "cliff", FunctionOutcome::unreachable)}),
            "cliff (x=190 y=60) is unreachable (says pathplan_svc, traverse_time, model 3)");
  EXPECT_EQ(
      words({use("here", "cliff", FunctionOutcome::unreachable), use("b", "cliff", FunctionOutcome::value)}),
      "")
      << "there is a way from b";
}

// An arm that goes there, and cannot carry its load there.
TEST(OwnersVerdicts, SpeakOfOneFunctionWhereAnotherHasAValue) {
  FunctionUse carried = use("here", "cliff", FunctionOutcome::unknown);
  carried.call.function = "carry_time";
  EXPECT_THAT(
      words({carried, use("here", "cliff", FunctionOutcome::value)}),
      HasSubstr("no way to cliff (x=190 y=60) is known: pathplan_svc found none with the effort spent "
                "(carry_time, model 3)"));
}

TEST(OwnersVerdicts, DoNotCallUnreachableWhatNobodyProved) {
  for (const bool first : {true, false}) {
    std::vector<FunctionUse> uses{use("here", "cliff", FunctionOutcome::unreachable),
                                  use("b", "cliff", FunctionOutcome::unknown)};
    if (first) std::swap(uses[0], uses[1]);
    EXPECT_THAT(words(uses),
                AllOf(HasSubstr("no way to cliff (x=190 y=60) is known: pathplan_svc found none with the "
                                "effort spent (traverse_time, model 3), which proves nothing"),
                      Not(HasSubstr("unreachable"))));
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::adapter
