#include "exec_svc/trace/renaming.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/exec_svc/trace/map_folder.hpp"

namespace roci::exec::trace {
namespace {

using ::testing::IsEmpty;
using testing::map_of;
using ::testing::SizeIs;

std::string renamed(const std::string& text, const std::string& sections) {
  Uses uses;
  return trace::renamed(text, map_of(sections), uses);
}

TEST(RenamingTest, WordsAreRenamedWholeAndAtOnce) {
  EXPECT_EQ(renamed("event a b a-b a.b b.", "names: {a: b, b: a}"), "event b a a-b a.b a.");
  EXPECT_EQ(renamed("event goal.achieved: goal", "names: {goal.achieved: goal.done}"),
            "event goal.done: goal");
  EXPECT_EQ(renamed("event (a,a) a=a", "names: {a: z}"), "event (z,z) a=z");
}

TEST(RenamingTest, KindsAndFieldsHaveNamesOfTheirOwn) {
  const std::string sections = "kinds: {ack: acknowledgement}\nkeys: {ack: code}";
  EXPECT_EQ(renamed("ack ack ack=ack", sections), "acknowledgement ack code=ack");
}

TEST(RenamingTest, RewritesFollowInTheirOrderAndSeeNewNames) {
  EXPECT_EQ(renamed("command drive 2 action=1",
                    R"(names: {drive: go}
rewrites:
  - {pattern: '^command (\S+) ([0-9]+)', with: 'command exec/1/\1/\2'}
  - {kind: command, pattern: 'exec/1/go', with: 'exec/1/walk'}
  - {kind: ack, pattern: 'walk', with: 'never'})"),
            "command exec/1/walk/2 action=1");
}

TEST(RenamingTest, UsesAreCountedByPlace) {
  Uses uses;
  const TraceMap map = map_of("names: {a: b, c: d}\nrewrites: [{pattern: b, with: e}]");
  trace::renamed("event a a", map, uses);
  EXPECT_EQ(uses[map.names.at("a").place], 2U);
  EXPECT_EQ(uses[map.rewrites.at(0).place], 1U);
  EXPECT_EQ(uses[map.names.at("c").place], 0U);
}

TEST(RenamingTest, AdditionsAreTakenOut) {
  const TraceMap map = map_of(R"(added:
  - {field: robot}
  - {kind: ack, pattern: ' took [0-9]+'}
  - {line: '^observation link\.'})");
  Uses uses;
  const auto left = without_additions({{{}, "command a robot=rover x=1", 1},
                                       {{}, "ack a robot=rover; took 7", 2},
                                       {{}, "observation link.up true", 3},
                                       {{}, "observation took 7", 4}},
                                      map, uses);
  ASSERT_THAT(left, SizeIs(3));
  EXPECT_EQ(left[0].text, "command a x=1");
  EXPECT_EQ(left[1].text, "ack a;");
  EXPECT_EQ(left[2].text, "observation took 7");
  EXPECT_EQ(left[2].number, 4U);
  EXPECT_EQ(uses[map.additions[0].place], 2U);
  EXPECT_EQ(uses[map.additions[1].place], 1U);
  EXPECT_EQ(uses[map.additions[2].place], 1U);
}

TEST(RenamingTest, AnEmptyMapChangesNothing) {
  Uses uses;
  EXPECT_EQ(trace::renamed("event a=b. (c) \xC3\xA9t\xC3\xA9", {}, uses), "event a=b. (c) \xC3\xA9t\xC3\xA9");
  EXPECT_THAT(uses, IsEmpty());
}

}  // namespace
}  // namespace roci::exec::trace
