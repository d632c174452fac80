// What definitions and footprints are refused for, and in which words.
#include "core/temporal/timelines/check.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

using Sentences = std::vector<std::string>;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::vector<Definition> kLines{
    {.name = "arm", .kind = Kind::atomic},
    {.name = "phase", .kind = Kind::state, .states = {"a", "b"}},
    {.name = "power", .kind = Kind::claimable},
    {.name = "stored", .kind = Kind::cumulative},
    {.name = "battery", .kind = Kind::cumulative_rate},
};

Sentences faults(const Impact& impact) {
  return check(kLines, Footprint{.duration = seconds(1), .impacts = {impact}});
}
Sentences faults(const Constraint& constraint) {
  return check(kLines, Footprint{.duration = seconds(1), .constraints = {constraint}});
}

TEST(TimelineCheck, EachKindPermitsWhatItSays) {
  using enum ImpactKind;
  using enum ImpactWhen;
  const auto permits = [](Index line, ImpactKind kind, ImpactWhen when) {
    return faults({line, kind, when, 1}).empty();
  };
  const std::vector<std::vector<bool>> expected{
      //  assign at_start, at_end, during; delta at_start, at_end, during; rate at_start, at_end, during
      {false, false, false, false, false, true, false, false, false},
      {true, true, false, false, false, false, false, false, false},
      {false, false, false, false, false, true, false, false, false},
      {true, true, false, true, true, true, false, false, false},
      {true, true, false, true, true, true, true, true, true},
  };
  for (Index line = 0; line < kLines.size(); ++line) {
    std::size_t i = 0;
    for (const ImpactKind kind : {assign, delta, rate})
      for (const ImpactWhen when : {at_start, at_end, during})
        EXPECT_EQ(permits(line, kind, when), expected[line][i++])
            << to_string(kLines[line].kind) << ", case " << i;
  }
}

TEST(TimelineCheck, SaysWhatIsWrongWithAnImpact) {
  EXPECT_EQ(
      faults(Impact{0, ImpactKind::delta, ImpactWhen::during, 2}),
      (Sentences{
          "the impact on the timeline 'arm' is not a delta of 1 during the task, the only one that an atomic "
          "timeline has"}));
  EXPECT_EQ(faults(Impact{1, ImpactKind::assign, ImpactWhen::at_end, 2}),
            (Sentences{"the impact on the timeline 'phase' assigns none of the timeline's states"}));
  EXPECT_EQ(faults(Impact{1, ImpactKind::assign, ImpactWhen::at_end, 0.5}).size(), 1U);
  EXPECT_EQ(faults(Impact{3, ImpactKind::rate, ImpactWhen::during, 1}),
            (Sentences{
                "the impact on the timeline 'stored' is a rate, which only a cumulative-rate timeline has"}));
  EXPECT_EQ(faults(Impact{4, ImpactKind::rate, ImpactWhen::during, 2e9}).size(), 1U);
  EXPECT_EQ(faults(Impact{4, ImpactKind::delta, ImpactWhen::at_end, kNaN}).size(), 1U);
  EXPECT_EQ(faults(Impact{5, ImpactKind::delta, ImpactWhen::at_end, 1}),
            (Sentences{"the impact is on a timeline that is not there"}));
}

TEST(TimelineCheck, SaysWhatIsWrongWithAConstraint) {
  EXPECT_TRUE(faults(Constraint{.timeline = 1, .states = 0b11}).empty());
  EXPECT_EQ(
      faults(Constraint{.timeline = 1, .states = 0b100}),
      (Sentences{"the constraint on the timeline 'phase' permits a state that the timeline does not have"}));
  EXPECT_EQ(faults(Constraint{.timeline = 1, .lowest = 0, .states = 1}),
            (Sentences{"the constraint on the timeline 'phase' has bounds, though the timeline has states"}));
  EXPECT_EQ(faults(Constraint{.timeline = 1}),
            (Sentences{"the constraint on the timeline 'phase' permits no state, and so never holds"}));
  EXPECT_EQ(
      faults(Constraint{.timeline = 3, .states = 1}),
      (Sentences{"the constraint on the timeline 'stored' names states, though the timeline has numbers"}));
  EXPECT_EQ(faults(Constraint{.timeline = 3, .lowest = 2, .highest = 1}).size(), 1U);
  EXPECT_EQ(faults(Constraint{.timeline = 3, .lowest = kNaN}).size(), 1U);
  EXPECT_EQ(faults(Constraint{.timeline = 9}).size(), 1U);
}

TEST(TimelineCheck, ListsAllFaultsOfAFootprint) {
  const Footprint footprint{
      Duration{-1},
      {{0, ImpactKind::rate, ImpactWhen::during, 1}, {2, ImpactKind::assign, ImpactWhen::at_end, 1}},
      {{.timeline = 1}}};
  EXPECT_EQ(check(kLines, footprint).size(), 4U);
  EXPECT_FALSE(permitted(kLines, footprint));
  EXPECT_TRUE(permitted(kLines, {}));
}

TEST(TimelineCheck, DefinitionsAreRefused) {
  const auto count = [](const Definition& definition) { return check(definition).size(); };
  for (const Definition& definition : kLines) EXPECT_EQ(count(definition), 0U);
  EXPECT_EQ(check({.name = "x", .initial = 5, .highest = 4}),
            (Sentences{"the timeline 'x' has an initial value outside of its range"}));
  EXPECT_EQ(count({.name = "", .kind = Kind::cumulative}), 1U);
  EXPECT_EQ(count({.name = "x", .lowest = 2, .highest = 1}), 1U);
  EXPECT_EQ(count({.name = "x", .initial = kNaN}), 1U);
  EXPECT_EQ(count({.name = "x", .highest = kNaN}), 1U);
  EXPECT_EQ(count({.name = "x", .kind = Kind::atomic, .initial = 1}), 1U);
  EXPECT_EQ(count({.name = "x", .kind = Kind::atomic, .highest = 2}), 1U);
  EXPECT_EQ(count({.name = "x", .kind = Kind::state}), 1U);
  EXPECT_EQ(count({.name = "x", .kind = Kind::state, .states = std::vector<std::string>(65, "s")}),
            1U + 65 * 64 / 2);
  EXPECT_EQ(count({.name = "x", .kind = Kind::state, .states = {"a", "a"}}), 1U);
  EXPECT_EQ(count({.name = "x", .kind = Kind::state, .states = {"a"}, .initial = 1}), 1U);
  EXPECT_EQ(count({.name = "x", .states = {"a"}}), 1U);
  EXPECT_THROW(Timelines({{.name = "x", .initial = 5, .highest = 4}}), std::invalid_argument);
}

TEST(TimelineCheck, PlacementsAreRefused) {
  Timelines lines(kLines, Extent{.end = seconds(100), .most_impacts = 3});
  const Footprint fine{
      seconds(10), {{3, ImpactKind::delta, ImpactWhen::at_end, 1}}, {{.timeline = 3, .lowest = 0}}};
  const Footprint wrong{seconds(10), {{3, ImpactKind::rate, ImpactWhen::at_end, 1}}, {}};
  lines.place(1, fine, seconds(90));
  EXPECT_THROW(lines.place(1, fine, seconds(0)), std::invalid_argument) << "it is placed already";
  EXPECT_THROW(lines.place(2, wrong, seconds(0)), std::invalid_argument);
  EXPECT_THROW(lines.valid_starts(wrong, {seconds(0), seconds(9)}), std::invalid_argument);
  EXPECT_THROW(lines.place(2, fine, seconds(91)), std::invalid_argument) << "it ends behind the end";
  EXPECT_THROW(lines.place(2, fine, seconds(0)), std::length_error) << "four impacts and constraints";
  EXPECT_THROW(lines.move(2, seconds(0), seconds(1)), std::invalid_argument);
  EXPECT_THROW(lines.move(1, seconds(1), seconds(0)), std::invalid_argument);
  EXPECT_THROW(lines.remove(2), std::invalid_argument);
  EXPECT_THROW(lines.observe(9, seconds(1), 0), std::invalid_argument);
  EXPECT_THROW(lines.observe(1, seconds(1), 2), std::invalid_argument) << "it has two states";
  EXPECT_THROW(lines.observe(3, seconds(1), kNaN), std::invalid_argument);
  EXPECT_THROW(lines.observe(3, seconds(101), 1), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(lines.value(9, seconds(1))), std::out_of_range);
  EXPECT_EQ(lines.kept(), (Kept{.tasks = 1, .events = 1, .asks = 1, .undoable = 1}))
      << "nothing is left of what was refused";
  lines.remove(1);
  EXPECT_NO_THROW(lines.place(2, fine, seconds(0))) << "what is removed makes room";
}

}  // namespace
}  // namespace roci::temporal::timelines
