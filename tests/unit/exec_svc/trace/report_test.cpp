#include "exec_svc/trace/report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/trace/map_folder.hpp"

namespace roci::exec::trace {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::map_of;
using ::testing::Not;
using testing::trace_of;

TEST(ReportTest, TheFirstDifferenceStandsBetweenTheLinesBeforeIt) {
  const Comparison found = compare(trace_of("0 ack a\n1 ack b\n2 ack c\n3 ack d"),
                                   trace_of("0 ack a\n1 ack b\n2 ack x\n3 ack y"), {});
  EXPECT_EQ(verdict(found), "different: 2 of 4 lines");
  EXPECT_EQ(differences(found, {1, 1, 100}),
            "difference 1 of 2:\n"
            "  OLD, as the map calls it\n"
            "    2: 1 s ack b\n"
            "  - 3: 2 s ack c\n"
            "  NEW, without what the map says was added\n"
            "    2: 1 s ack b\n"
            "  + 3: 2 s ack x\n");
}

TEST(ReportTest, AMissingLineIsSaid) {
  const Comparison found = compare(trace_of("0 ack a\n1 ack b"), trace_of("0 ack a"), {});
  EXPECT_THAT(differences(found),
              AllOf(HasSubstr("- 2: 1 s ack b"), HasSubstr("1: 0 s ack a\n  + (no such line)")));
}

TEST(ReportTest, OfLongLinesThePartThatDiffersIsShown) {
  const std::string row(5000, 'x');
  const Comparison found =
      compare(trace_of("0 plan " + row + "a" + row), trace_of("0 plan " + row + "b" + row), {});
  const std::string text = differences(found, {1, 3, 60});
  EXPECT_THAT(text, AllOf(HasSubstr("xxxaxxx"), HasSubstr("xxxbxxx"), HasSubstr("...")));
  EXPECT_LT(text.size(), 400U);
}

TEST(ReportTest, RulesThatMatchNothingAreReported) {
  const TraceMap map = map_of(R"(names: {b: c}
accepted:
  - {scenario: '^nominal$', old: '^ack z', reason: the first}
  - {scenario: '^arm_fault$', old: '^ack z', reason: the second}
  - {old: '^ack a', reason: the third})");
  const Comparison found = compare(trace_of("0 ack a"), trace_of(""), map);
  EXPECT_EQ(verdict(found), "equal: 1 lines, 1 differing lines accepted");
  EXPECT_THAT(useless_rules(map, found.uses, "nominal", false),
              AllOf(HasSubstr("a.map.yaml:4:5: the accepted difference 'the first' matches nothing"),
                    Not(HasSubstr("the second")), Not(HasSubstr("the third")), Not(HasSubstr("the name"))));
  EXPECT_THAT(
      useless_rules(map, found.uses, "", true),
      AllOf(HasSubstr("the name 'b' matches nothing"), HasSubstr("the first"), HasSubstr("the second")));
}

}  // namespace
}  // namespace roci::exec::trace
