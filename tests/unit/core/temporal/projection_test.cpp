// Planned, executed and projected values against hand-made cases, and against sums over all impacts on random
// plans.
#include "core/temporal/projection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace roci::temporal {
namespace {

using ::testing::ElementsAre;

PlanActivity& add(FlexiblePlan& plan, const std::string& id, double duration_s, std::vector<Impact> impacts) {
  PlanActivity& out = plan.activities.emplace_back();
  out.id = id;
  out.start_point = plan.point_count++;
  out.end_point = plan.point_count++;
  out.duration_lower = seconds(duration_s);
  out.impacts = std::move(impacts);
  return out;
}

// Drive for 100 s from a to b, at 2 J/s, then an image of 40 s that takes 50 J.
FlexiblePlan drive_and_image() {
  FlexiblePlan plan;
  plan.origin = seconds(10);
  add(plan, "drive", 100,
      {{"at a", ImpactKind::assign, ImpactWhen::at_start, false},
       {"at b", ImpactKind::assign, ImpactWhen::at_end, true},
       {"energy", ImpactKind::rate, ImpactWhen::during, -2.0}});
  add(plan, "image", 40,
      {{"energy", ImpactKind::delta, ImpactWhen::at_start, -50.0},
       {"taken", ImpactKind::assign, ImpactWhen::at_end, true}});
  plan.constraints.push_back({2, 3, ConstraintKind::ordering, seconds(1), no_bound});
  return plan;
}

std::vector<std::string> words(const std::vector<ProjectedChange>& changes) {
  std::vector<std::string> out;
  for (const ProjectedChange& change : changes)
    out.push_back(std::string(to_string(change.kind)) + " " + std::to_string(change.time / seconds(1)) + " " +
                  to_text(change.value));
  return out;
}

TEST(Projection, OfAPlanThatHasNotBegun) {
  const auto out = project(drive_and_image(), {}, seconds(0), {{"energy", 1000.0}});
  EXPECT_THAT(words(out.at("energy")),
              ElementsAre("planned 10 1000", "planned 110 800", "planned 111 750", "projected 10 1000",
                          "projected 110 800", "projected 111 750"));
  EXPECT_THAT(words(out.at("at b")), ElementsAre("planned 110 true", "projected 110 true"));
}

// R76: the drive began late and lasts; at 150 s it is 20 s longer under way than planned.
TEST(Projection, ALateStartAndAnOverrunMoveWhatFollows) {
  Progress progress;
  progress["drive"] = {ActivityState::running, seconds(30), {}};
  const auto out = project(drive_and_image(), progress, seconds(150), {{"energy", 1000.0}});
  EXPECT_THAT(words(out.at("at a")), ElementsAre("planned 10 false", "executed 30 false"));
  EXPECT_THAT(words(out.at("at b")), ElementsAre("planned 110 true", "projected 150 true"));
  EXPECT_THAT(words(out.at("taken")), ElementsAre("planned 151 true", "projected 191 true"));
  EXPECT_EQ(words(out.at("energy")).back(), "projected 151 710");
}

TEST(Projection, WhatFailedHasNoEffectAtItsEndAndItsRateStops) {
  Progress progress;
  progress["drive"] = {ActivityState::failed, seconds(10), seconds(60)};
  progress["image"] = {ActivityState::cancelled, {}, {}};
  const auto out = project(drive_and_image(), progress, seconds(70), {});
  EXPECT_THAT(words(out.at("at b")), ElementsAre("planned 110 true"));
  EXPECT_THAT(words(out.at("taken")), ElementsAre("planned 151 true"));
  EXPECT_THAT(words(out.at("energy")), ElementsAre("planned 10 0", "planned 110 -200", "planned 111 -250",
                                                   "executed 10 0", "executed 60 -100"));
}

// R76: the drive has taken more than planned; what is still to come starts from what was seen.
TEST(Projection, StartsAtTheNewestObservation) {
  Progress progress;
  progress["drive"] = {ActivityState::running, seconds(10), {}};
  const ObservedValues observed{{"energy", {seconds(60), 700.0}}};
  const auto out = project(drive_and_image(), progress, seconds(70), {{"energy", 1000.0}}, observed);
  EXPECT_THAT(words(out.at("energy")),
              ElementsAre("planned 10 1000", "planned 110 800", "planned 111 750", "executed 10 1000",
                          "executed 60 700", "projected 110 600", "projected 111 550"));
  EXPECT_EQ(out.at("energy")[4].activity, "") << "nobody's: it was seen";
}

// What ended after the sample was taken is not in it.
TEST(Projection, AnObservationShowsWhatWasExecutedBeforeItAlone) {
  Progress progress;
  progress["drive"] = {ActivityState::succeeded, seconds(10), seconds(110)};
  progress["image"] = {ActivityState::running, seconds(120), {}};
  const ObservedValues observed{{"energy", {seconds(115), 640.0}}, {"at b", {seconds(112), false}}};
  const auto out = project(drive_and_image(), progress, seconds(130), {{"energy", 1000.0}}, observed);
  EXPECT_THAT(words(out.at("energy")),
              ElementsAre("planned 10 1000", "planned 110 800", "planned 111 750", "executed 10 1000",
                          "executed 110 800", "executed 115 640", "executed 120 590"));
  EXPECT_THAT(words(out.at("at b")),
              ElementsAre("planned 110 true", "executed 110 true", "executed 112 false"));
}

// The drive has taken 2 a second for 50 s, so the plan began with 750.
TEST(Projection, WhatAPlanBeganWithIsReckonedBackFromTheObservation) {
  Progress progress;
  progress["drive"] = {ActivityState::running, seconds(10), {}};
  const ObservedValues observed{{"energy", {seconds(60), 650.0}}};
  const auto out = project(drive_and_image(), progress, seconds(70), {}, observed);
  EXPECT_THAT(words(out.at("energy")),
              ElementsAre("planned 10 750", "planned 110 550", "planned 111 500", "executed 10 750",
                          "executed 60 650", "projected 110 550", "projected 111 500"));
}

TEST(Projection, AnObservationOfAPlanThatHasNotBegunIsWhereItStarts) {
  const ObservedValues observed{{"energy", {seconds(5), 500.0}}, {"untouched", {seconds(5), 1.0}}};
  const auto out = project(drive_and_image(), {}, seconds(10), {}, observed);
  EXPECT_EQ(words(out.at("energy")).back(), "projected 111 250");
  EXPECT_FALSE(out.contains("untouched"));
}

// One impact as it really comes about.
struct Effect {
  const Impact* impact;
  Time start, end;
  std::size_t activity;
  bool ends;
  int turn(bool at_end) const { return at_end ? (start == end ? 2 : 0) : 1; }
};

using Moment = std::tuple<Time, int, std::size_t>;

// The value right after `moment`: the last assignment until then, and all that was added since.
double value_at(const std::vector<Effect>& effects, const Moment& moment) {
  Moment since{Time::min(), 0, 0};
  double value = 0;
  for (const Effect& effect : effects) {
    const bool at_end = effect.impact->moment == ImpactWhen::at_end;
    const Moment own{at_end ? effect.end : effect.start, effect.turn(at_end), effect.activity};
    if (effect.impact->kind != ImpactKind::assign || own > moment || own < since || (at_end && !effect.ends))
      continue;
    since = own;
    value = std::get<double>(effect.impact->amount);
  }
  for (const Effect& effect : effects) {
    const double amount = std::get<double>(effect.impact->amount);
    const bool at_end = effect.impact->moment == ImpactWhen::at_end;
    const Moment own{at_end ? effect.end : effect.start, effect.turn(at_end), effect.activity};
    if (effect.impact->kind == ImpactKind::delta && own <= moment && own > since && (!at_end || effect.ends))
      value += amount;
    if (effect.impact->kind == ImpactKind::rate) {
      const Time from = std::max(effect.start, std::get<0>(since));
      const Time to = std::min(effect.end, std::get<0>(moment));
      if (to > from) value += amount * to_seconds(to - from);
    }
  }
  return value;
}

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}
  std::int64_t below(std::uint64_t n) { return static_cast<std::int64_t>(random_() % n); }
  Duration seconds_below(std::uint64_t n) { return seconds(static_cast<double>(below(n))); }

 private:
  std::mt19937_64 random_;
};

// None to two impacts of one kind on the level.
std::vector<Impact> draw_impacts(Dice& dice) {
  std::vector<Impact> out;
  for (auto n = dice.below(3); n > 0; --n) {
    const auto kind = static_cast<ImpactKind>(dice.below(3));
    const auto moment =
        kind == ImpactKind::rate ? ImpactWhen::during : static_cast<ImpactWhen>(dice.below(2));
    out.push_back({"level", kind, moment, static_cast<double>(dice.below(21) - 10)});
  }
  if (out.size() == 2 && out[0].kind != out[1].kind) out.pop_back();
  if (out.size() == 2 && out[0].kind == ImpactKind::assign) out.pop_back();
  return out;
}

// One to eight activities, some of which come behind another one.
FlexiblePlan draw_plan(Dice& dice) {
  FlexiblePlan plan;
  plan.origin = dice.seconds_below(50);
  const auto count = 1 + static_cast<std::size_t>(dice.below(8));
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<Impact> impacts = draw_impacts(dice);
    add(plan, "a" + std::to_string(i), static_cast<double>(dice.below(20)), std::move(impacts));
    if (i == 0 || dice.below(2) != 0) continue;
    const auto before = static_cast<TimePoint>(2 + 2 * dice.below(i));
    plan.constraints.push_back(
        {before, plan.activities[i].start_point, ConstraintKind::ordering, dice.seconds_below(3), no_bound});
  }
  return plan;
}

struct HalfWay {
  Progress progress;
  std::vector<Effect> effects;  // of what was executed and of what is to come
};

// The first activities in plan order have run, each late by a little; one may have failed.
HalfWay fly_until(Time now, const FlexiblePlan& plan, Dice& dice) {
  HalfWay out;
  std::vector<Time> earliest(plan.point_count, plan.origin);
  for (std::size_t i = 0; i < plan.activities.size(); ++i) {
    const PlanActivity& activity = plan.activities[i];
    Time start = plan.origin;
    for (const TemporalConstraint& c : plan.constraints)
      if (c.to_point == activity.start_point) start = std::max(start, earliest[c.from_point] + c.lower);
    const Time late = start + dice.seconds_below(5);
    const Time ended = late + activity.duration_lower + dice.seconds_below(5);
    ActivityProgress& at = out.progress[activity.id];
    bool ends = true;
    Time end{0};
    if (late > now) {
      start = std::max(start, now);
      end = start + activity.duration_lower;
    } else {
      start = late;
      at = {ActivityState::running, start, {}};
      end = std::max(now, start + activity.duration_lower);
      if (ended <= now) {
        end = ended;
        ends = dice.below(5) != 0;
        at = {ends ? ActivityState::succeeded : ActivityState::failed, start, end};
      }
    }
    earliest[activity.start_point] = start;
    earliest[activity.end_point] = end;
    for (const Impact& impact : activity.impacts) out.effects.push_back({&impact, start, end, i, ends});
  }
  return out;
}

// Every change that the effects make is among those of the level, with the value that the sums give. Returns how many
// there are.
std::size_t expect_all(const std::vector<Effect>& effects, const FlexiblePlan& plan,
                       const std::vector<ProjectedChange>& level) {
  std::size_t seen = 0;
  for (const Effect& effect : effects) {
    for (const bool at_end : {false, true}) {
      const bool rate = effect.impact->kind == ImpactKind::rate;
      const bool here = rate || (effect.impact->moment == ImpactWhen::at_end) == at_end;
      if (!here || (at_end && !rate && !effect.ends)) continue;
      ++seen;
      const Moment moment{at_end ? effect.end : effect.start, effect.turn(at_end), effect.activity};
      const double expected = value_at(effects, moment);
      const bool found = std::ranges::any_of(level, [&](const ProjectedChange& change) {
        return change.kind != ProjectionKind::planned && change.time == std::get<0>(moment) &&
               change.activity == plan.activities[effect.activity].id &&
               std::abs(std::get<double>(change.value) - expected) < 1e-9;
      });
      EXPECT_TRUE(found) << "at " << to_text(std::get<0>(moment)) << ": " << expected;
    }
  }
  return seen;
}

TEST(Projection, AgreesWithSumsOverAllImpactsOnRandomPlansHalfWayThrough) {
  Dice dice(7);
  std::size_t compared = 0;
  for (int round = 0; round < 500; ++round) {
    SCOPED_TRACE("round " + std::to_string(round));
    const FlexiblePlan plan = draw_plan(dice);
    const Time now = plan.origin + dice.seconds_below(60);
    const HalfWay flown = fly_until(now, plan, dice);
    const auto level = project(plan, flown.progress, now, {})["level"];
    const std::size_t seen = expect_all(flown.effects, plan, level);
    const auto real = std::ranges::count_if(
        level, [](const ProjectedChange& change) { return change.kind != ProjectionKind::planned; });
    EXPECT_EQ(static_cast<std::size_t>(real), seen);
    compared += seen;
  }
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace roci::temporal
