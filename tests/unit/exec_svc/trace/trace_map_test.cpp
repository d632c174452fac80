#include "exec_svc/trace/trace_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/trace/map_folder.hpp"

namespace roci::exec::trace {
namespace {

using ::testing::AllOf;
using testing::complaint_about;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::map_of;
using ::testing::SizeIs;
using ::testing::StartsWith;

TEST(TraceMapTest, TheCommittedMapIsRead) {
  EXPECT_NO_THROW(read_map(ROCI_SOURCE_DIR "/tests/scenario/traces/baseline-05.map.yaml"));
}

TEST(TraceMapTest, EverySectionIsRead) {
  const TraceMap map = map_of(R"(names: {a: b, c: d}
kinds: {ack: answer}
keys: {x: y}
rewrites: [{pattern: a, with: b}]
added: [{field: robot}]
free_order: [{kinds: [ack], reason: topics}]
accepted: [{new: a, reason: because}])");
  EXPECT_THAT(map.names, SizeIs(2));
  EXPECT_EQ(map.kinds.at("ack").to, "answer");
  EXPECT_EQ(map.keys.at("x").to, "y");
  EXPECT_THAT(map.rewrites, SizeIs(1));
  EXPECT_THAT(map.additions, SizeIs(1));
  EXPECT_THAT(map.free_orders, SizeIs(1));
  EXPECT_THAT(map.accepted, SizeIs(1));
  EXPECT_THAT(map_of("names: {}\nrewrites: []\naccepted:").accepted, IsEmpty());
}

std::string about(const std::string& sections) { return complaint_about("format: 1\n" + sections); }

TEST(TraceMapTest, BadMapsAreRefusedWithPlaceAndRemedy) {
  EXPECT_THAT(complaint_about("names: {}"), HasSubstr("'format' is missing; add it"));
  EXPECT_THAT(complaint_about("format: 2\n"),
              AllOf(StartsWith("a.map.yaml:1:9: a map of format 2"), HasSubstr("reads format 1")));
  EXPECT_THAT(about("name: {a: b}"),
              AllOf(StartsWith("a.map.yaml:2:1: "), HasSubstr("known here: format, names")));
  EXPECT_THAT(about("names: {a: b c}"),
              AllOf(StartsWith("a.map.yaml:2:12: "), HasSubstr("put it into rewrites")));
  EXPECT_THAT(about("names: {a: a}"), HasSubstr("renamed to itself; remove"));
  EXPECT_THAT(about("names:\n  a: b\n  a: c"),
              AllOf(StartsWith("a.map.yaml:4:6: "), HasSubstr("renamed twice")));
  EXPECT_THAT(
      about("rewrites: [{pattern: '(a', with: b}]"),
      AllOf(StartsWith("a.map.yaml:2:22: "), HasSubstr("is no regular expression"), HasSubstr("POSIX")));
  EXPECT_THAT(about("rewrites: [{pattern: a, with: '\\1'}]"),
              AllOf(StartsWith("a.map.yaml:2:31: "), HasSubstr("there is no group \\1")));
  EXPECT_THAT(about("rewrites: [{pattern: a}]"), HasSubstr("'with' is missing; add it"));
  EXPECT_THAT(about("added: [{kind: ack}]"), HasSubstr("exactly one of 'field', 'pattern' and 'line'"));
  EXPECT_THAT(about("added: [{field: a, line: b}]"), HasSubstr("exactly one of"));
  EXPECT_THAT(about("free_order: [{kinds: [ack]}]"), HasSubstr("'reason' is missing"));
  EXPECT_THAT(about("accepted: [{old: a}]"), HasSubstr("'reason' is missing"));
  EXPECT_THAT(about("accepted: [{old: a, reason: ''}]"), HasSubstr("say why"));
  EXPECT_THAT(about("accepted: [{reason: b}]"), HasSubstr("neither 'old' nor 'new'"));
  EXPECT_THAT(about("accepted: [{old: a, since: later, reason: b}]"), StartsWith("a.map.yaml:2:28: "));
  EXPECT_THAT(about("accepted: [{old: a, since: -1, reason: b}]"), HasSubstr("no mission time"));
  EXPECT_THAT(about("accepted: {old: a}"), HasSubstr("expected a list"));
  EXPECT_THAT(about("names: [a"), HasSubstr("not valid YAML"));
}

}  // namespace
}  // namespace roci::exec::trace
