#include "exec_svc/trace/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/unit/exec_svc/trace/map_folder.hpp"

namespace roci::exec::trace {
namespace {

using ::testing::ElementsAre;
using testing::map_of;
using testing::trace_of;

const char* const kOld =
    "0 observation a 1\n"
    "1 plan p 1\n"
    "1 command drive 1\n"
    "2 ack drive 1\n"
    "2 observation a 2\n"
    "2 observation b 3\n";

Comparison compare(const std::string& before, const std::string& after, const std::string& sections = "") {
  return trace::compare(trace_of(before), trace_of(after), map_of(sections));
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(ComparisonTest, TheSameLinesAreEqual) {
  EXPECT_TRUE(compare(kOld, kOld).equal());
  EXPECT_TRUE(compare("", "").equal());
}

TEST(ComparisonTest, OneChangedLineIsOneDifference) {
  EXPECT_THAT(compare(kOld, with(kOld, "ack drive 1", "ack drive 2")).differences,
              ElementsAre(Difference{3, 3}));
}

TEST(ComparisonTest, ALineTooManyOrTooFewMovesNoOthers) {
  EXPECT_THAT(compare(kOld, with(kOld, "1 command", "1 command stop 1\n1 command")).differences,
              ElementsAre(Difference{std::nullopt, 2}));
  EXPECT_THAT(compare(kOld, with(kOld, "0 observation a 1\n", "")).differences,
              ElementsAre(Difference{0, std::nullopt}));
  EXPECT_THAT(compare(kOld, "").differences, ::testing::SizeIs(6));
}

TEST(ComparisonTest, AnotherMissionTimeIsADifference) {
  EXPECT_THAT(compare(kOld, with(kOld, "0 observation", "0.5 observation")).differences,
              ElementsAre(Difference{0, std::nullopt}, Difference{std::nullopt, 0}));
}

TEST(ComparisonTest, OldIsRenamedAndNewLosesItsAdditions) {
  const std::string sections = "kinds: {ack: acknowledgement}\nadded: [{field: robot}]";
  const std::string renamed =
      with(with(kOld, "ack drive 1", "acknowledgement drive 1"), "drive 1\n2", "drive 1 robot=r\n2");
  EXPECT_TRUE(compare(kOld, renamed, sections).equal());
  EXPECT_FALSE(compare(kOld, renamed, "kinds: {ack: acknowledgement}").equal());
  EXPECT_FALSE(compare(renamed, kOld, sections).equal()) << "the map leads from OLD to NEW alone";
}

const std::string kMoved =
    with(with(kOld, "2 ack drive 1\n", ""), "2 observation b 3\n", "2 observation b 3\n2 ack drive 1\n");

TEST(ComparisonTest, OrderCountsUnlessTheMapFreesIt) {
  EXPECT_THAT(compare(kOld, kMoved).differences,
              ElementsAre(Difference{3, std::nullopt}, Difference{std::nullopt, 5}));
  EXPECT_TRUE(compare(kOld, kMoved, "free_order: [{kinds: [ack], reason: topics are named anew}]").equal());
  EXPECT_FALSE(
      compare(kOld, kMoved, "free_order: [{kinds: [command], reason: topics are named anew}]").equal());
  EXPECT_FALSE(compare(kOld, with(kMoved, "2 ack drive 1", "2 ack drive 2"),
                       "free_order: [{kinds: [ack], reason: topics are named anew}]")
                   .equal());
}

TEST(ComparisonTest, AnAcceptedDifferenceIsCountedAndNoMore) {
  const std::string changed = with(kOld, "ack drive 1", "ack drive 2");
  const Comparison found =
      compare(kOld, changed, "accepted: [{old: '^ack', new: '^ack drive 2$', reason: counts on}]");
  EXPECT_TRUE(found.equal());
  EXPECT_EQ(found.accepted, 1U);
  EXPECT_FALSE(compare(kOld, with(kOld, "ack drive 1", "ack drive 3"),
                       "accepted: [{old: '^ack', new: '^ack drive 2$', reason: counts on}]")
                   .equal());
}

TEST(ComparisonTest, AcceptingAChangeAcceptsNoMissingLine) {
  const std::string sections = "accepted: [{old: '^ack', new: '^ack drive 2$', reason: counts on}]";
  EXPECT_FALSE(compare(kOld, with(kOld, "2 ack drive 1\n", ""), sections).equal());
  EXPECT_FALSE(
      compare(with(kOld, "ack drive 1", "stop"), with(kOld, "ack drive 1", "ack drive 2"), sections).equal());
}

TEST(ComparisonTest, AcceptingOneSideAcceptsNoChange) {
  const std::string changed = with(kOld, "ack drive 1", "ack drive 2");
  EXPECT_THAT(compare(kOld, changed, "accepted: [{old: '^ack', reason: not sent}]").differences,
              ElementsAre(Difference{std::nullopt, 3}));
  EXPECT_TRUE(compare(kOld, with(kOld, "2 ack drive 1\n", ""), "accepted: [{old: '^ack', reason: not sent}]")
                  .equal());
  EXPECT_TRUE(
      compare(with(kOld, "2 ack drive 1\n", ""), kOld, "accepted: [{new: '^ack', reason: sent}]").equal());
}

TEST(ComparisonTest, NothingIsAcceptedBeforeItsTime) {
  const std::string changed = with(kOld, "2 ack drive 1", "2 ack drive 2");
  EXPECT_TRUE(
      compare(kOld, changed, "accepted: [{since: 2, old: '.', new: '.', reason: counts on}]").equal());
  EXPECT_FALSE(
      compare(kOld, changed, "accepted: [{since: 2.000001, old: '.', new: '.', reason: later}]").equal());
}

TEST(ComparisonTest, AnAcceptedDifferenceHoldsInItsScenarioAlone) {
  const std::string sections = "accepted: [{scenario: '^nom', old: '^ack', reason: not sent}]";
  const TraceMap map = map_of(sections);
  const auto shorter = with(kOld, "2 ack drive 1\n", "");
  EXPECT_TRUE(trace::compare(trace_of(kOld), trace_of(shorter), map).equal());
  EXPECT_FALSE(trace::compare(trace_of(kOld, "arm_fault"), trace_of(shorter, "arm_fault"), map).equal());
}

// Of random traces: no difference is reported for the same ones, and one change is always found.
TEST(ComparisonTest, RandomChangesAreFound) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    RecordedTrace before;
    for (std::size_t i = 0, n = 1 + random() % 40; i < n; ++i) {
      const auto last = before.lines.empty() ? temporal::Time(0) : before.lines.back().time;
      before.lines.push_back(
          {last + temporal::Time(random() % 3 == 0), "ack " + std::to_string(random() % 3), i + 1});
    }
    EXPECT_TRUE(trace::compare(before, before, {}).equal());
    RecordedTrace after = before;
    const auto at = after.lines.begin() + static_cast<std::ptrdiff_t>(random() % after.lines.size());
    const unsigned change = random() % 3;
    if (change == 0) after.lines.erase(at);
    if (change == 1) after.lines.insert(at, *at);
    if (change == 2) at->text += "x";
    EXPECT_THAT(trace::compare(before, after, {}).differences, ::testing::SizeIs(1));
    EXPECT_THAT(trace::compare(after, before, {}).differences, ::testing::SizeIs(1));
  }
}

}  // namespace
}  // namespace roci::exec::trace
