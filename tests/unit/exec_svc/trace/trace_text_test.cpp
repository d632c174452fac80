#include "exec_svc/trace/trace_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace roci::exec::trace {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

RecordedTrace parsed(const std::string& text) {
  std::istringstream in(text);
  return parse(in, "a.trace");
}

std::string complaint(const std::string& text) {
  try {
    parsed(text);
  } catch (const TraceError& error) {
    return error.what();
  }
  return "";
}

TEST(TraceTextTest, WhatIsPrintedComesBack) {
  RecordedTrace trace{"nominal", 7, true, {}};
  trace.lines = {{temporal::Time(0), "observation a 1", 1},
                 {temporal::Time(1'500'000), "call (define\n  (problem p)) \\n \\", 2},
                 {temporal::Time(1'500'000), "", 3}};
  std::ostringstream out;
  print(out, trace);
  EXPECT_EQ(parsed(out.str()), trace);
}

TEST(TraceTextTest, TheTextIsAsPublished) {
  std::ostringstream out;
  print(out, {"nominal", 7, false, {{temporal::Time(1'500'000), "ack drive 1", 1}}});
  EXPECT_EQ(out.str(), "roci-trace 1 scenario=nominal seed=7 lines=trace\n1500000 ack drive 1\n");
}

TEST(TraceTextTest, BadTextIsRefusedWithLineAndRemedy) {
  EXPECT_THAT(complaint(""), AllOf(StartsWith("a.trace:1: "), HasSubstr("write one with")));
  EXPECT_THAT(complaint("0 observation a 1\n"),
              AllOf(StartsWith("a.trace:1: "), HasSubstr("roci-trace print wrote")));
  EXPECT_THAT(complaint("roci-trace one\n"), HasSubstr("names no version"));
  EXPECT_THAT(complaint("roci-trace 1 colour=red\n"), HasSubstr("'colour=red' is not known"));
  EXPECT_THAT(complaint("roci-trace 1\n0 ack a\nack b\n"), StartsWith("a.trace:3: a line begins with"));
  EXPECT_THAT(complaint("roci-trace 1\n0 ack \\t\n"), StartsWith("a.trace:2: a backslash stands alone"));
}

TEST(TraceTextTest, ANewerFormatIsRefusedInWords) {
  EXPECT_THAT(
      complaint("roci-trace 2 lines=trace\n0 something else\n"),
      AllOf(HasSubstr("trace of format 2"), HasSubstr("reads up to 1"), HasSubstr("version that wrote it")));
}

}  // namespace
}  // namespace roci::exec::trace
