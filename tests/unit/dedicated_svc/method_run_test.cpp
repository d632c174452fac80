// R145, R146: call order, failed and wrong values, repairs.
#include "dedicated_svc/method_run/method_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/mission/entry.hpp"
#include "dedicated_svc/methods/methods_file.hpp"

namespace roci::dedicated::method_run {
namespace {

using methods::CommandCall;
using methods::Methods;
using temporal::state;
using testing::HasSubstr;

// TurnToWP as section 5.2 of the paper tells it, and a traverse that can be repaired.
constexpr char kMethods[] = R"(
dedicated:
  timeline: primary.locomotion
  subsystem: locomotion
  methods:
    TurnToWP:
      arguments: [wp]
      calls:
        - {name: next, path: {planner: nav, from: {robot: primary}, to: {object: "{wp}"}}}
        - {name: local, transform: {place: {x: "{next.next_x}", y: "{next.next_y}"}, robot: primary}}
        - name: turn
          command: {owner: sim_svc, robot: primary, subsystem: nav, name: turn, arguments: {heading: "{local.heading_rad}"}}
          check: {final_error_rad: {at_most: 0.1}}
      during: [turning, "{wp}"]
      then: [facing, "{wp}"]
      results: {length_m: "{next.length_m}"}
    Traverse:
      arguments: [wp]
      calls:
        - {name: path, path: {planner: nav, from: {robot: scout}, to: {object: "{wp}"}}}
        - {name: drive, command: {owner: sim_svc, robot: scout, subsystem: nav, name: drive, arguments: {to: "{wp}"}}}
      repairs:
        no-go:
          calls:
            - {name: circle, observe: {timeline: scout.map}}
            - {name: other, path: {planner: primary_nav, from: {robot: primary}, to: {object: "{wp}"}}}
          then: path
          at_most: 2
          needs: {scout.battery: {at_least: 100}}
      failed: {no-go: [hazard-detected, "{wp}"], "*": [failed]}
)";

const Methods& example() {
  static const Methods methods =
      methods::read_methods(mission::Entry::parse(kMethods, "mission.yaml").at("dedicated"));
  return methods;
}

Answer numbers(std::map<std::string, double> values) {
  Answer answer;
  for (const auto& [name, value] : values) answer.values[name] = value;
  return answer;
}

Answer error(const std::string& code) { return {code, "as told", {}, 10.0}; }

std::string asked(const Step& step) {
  if (!step.ask) return step.end ? "end " + step.end->error : "nothing";
  return std::to_string(step.ask->number) + " " + step.ask->call.name;
}

const Observations kRich{{"scout.battery", 1000.0}};

TEST(MethodRun, CallsInOrderAndHandsValuesOn) {
  MethodRun run(example().methods.at("TurnToWP"), {{"wp", "w3"}});
  EXPECT_EQ(run.during(), state("turning", {"w3"}));
  Step step = run.begin();
  EXPECT_EQ(asked(step), "1 next");
  EXPECT_EQ(std::get<methods::PathCall>(step.ask->call.what).to.object, "w3");
  step = run.take(numbers({{"next_x", 1.5}, {"next_y", -2}, {"length_m", 4}}), {});
  EXPECT_EQ(asked(step), "2 local");
  EXPECT_EQ(std::get<methods::TransformCall>(step.ask->call.what).place.x, "1.5");
  EXPECT_EQ(std::get<methods::TransformCall>(step.ask->call.what).place.y, "-2");
  step = run.take(numbers({{"heading_rad", 0.1}}), {});
  EXPECT_EQ(std::get<CommandCall>(step.ask->call.what).arguments.at("heading"), "0.1");
  Answer turned = numbers({{"final_error_rad", 0.01}});
  turned.energy_j = 30;
  step = run.take(turned, {});
  ASSERT_TRUE(step.end);
  EXPECT_EQ(step.end->error, "");
  EXPECT_EQ(step.end->values, (std::map<std::string, temporal::Value>{{"length_m", 4.0}}));
  EXPECT_EQ(step.end->energy_j, 30);
  EXPECT_EQ(run.then(example().rest), state("facing", {"w3"}));
}

TEST(MethodRun, AFailedCallAndAWrongOrMissingValueEndIt) {
  const auto after_two = [](const Answer& third) {
    MethodRun run(example().methods.at("TurnToWP"), {{"wp", "w3"}});
    run.begin();
    run.take(numbers({{"next_x", 1}, {"next_y", 2}, {"length_m", 4}}), {});
    run.take(numbers({{"heading_rad", 0.1}}), {});
    return *run.take(third, {}).end;
  };
  EXPECT_EQ(after_two(error("stalled")).error, "stalled");
  EXPECT_EQ(after_two(error("stalled")).reason, "turn: as told");
  const End wrong = after_two(numbers({{"final_error_rad", 0.5}}));
  EXPECT_EQ(wrong.error, "wrong-value");
  EXPECT_EQ(wrong.reason, "turn: turn brought final_error_rad = 0.5");
  EXPECT_EQ(wrong.values.at("final_error_rad"), temporal::Value(0.5)) << "what was wrong is told upwards";
  EXPECT_THAT(after_two(numbers({})).reason, HasSubstr("turn brought no number 'final_error_rad'"));

  MethodRun run(example().methods.at("TurnToWP"), {{"wp", "w3"}});
  run.begin();
  const Step step = run.take(numbers({{"length_m", 4}}), {});
  ASSERT_TRUE(step.end) << "the way-point that the transform needs was not brought";
  EXPECT_EQ(step.end->error, "wrong-value");
}

TEST(MethodRun, ARepairRunsAndGoesOnWhereItSays) {
  MethodRun run(example().methods.at("Traverse"), {{"wp", "w3"}});
  EXPECT_EQ(run.during(), state("Traverse", {"w3"}));
  EXPECT_EQ(asked(run.begin()), "1 path");
  EXPECT_EQ(asked(run.take({}, kRich)), "2 drive");
  Step step = run.take(error("no-go"), kRich);
  EXPECT_EQ(asked(step), "3 circle");
  EXPECT_EQ(step.repairing, "drive: as told");
  step = run.take({}, kRich);
  EXPECT_EQ(asked(step), "4 other");
  EXPECT_EQ(step.repairing, "") << "one repair is said once";
  EXPECT_EQ(asked(run.take({}, kRich)), "5 path");
  EXPECT_EQ(asked(run.take({}, kRich)), "6 drive");
  Answer there;
  there.energy_j = 100;
  step = run.take(there, kRich);
  ASSERT_TRUE(step.end);
  EXPECT_EQ(step.end->error, "");
  EXPECT_EQ(step.end->energy_j, 110) << "what the failed try drew counts, too";
}

TEST(MethodRun, ARepairMayEndTheMethod) {
  constexpr char kText[] = R"(
dedicated:
  timeline: t
  subsystem: s
  methods:
    Go:
      calls:
        - {name: way, observe: {timeline: way}}
        - {name: drive, command: {owner: o, subsystem: nav, name: drive}}
        - {name: look, command: {owner: o, subsystem: eye, name: look}}
      repairs:
        drive.blocked: {calls: [{name: around, command: {owner: o, subsystem: nav, name: around}}], then: end}
      during: [going]
      results: {x: "{way.x}"}
      then: [there]
)";
  const Methods methods = methods::read_methods(mission::Entry::parse(kText, "m").at("dedicated"));
  MethodRun run(methods.methods.at("Go"), {});
  EXPECT_EQ(asked(run.begin()), "1 way");
  EXPECT_EQ(asked(run.take(numbers({{"x", 2}}), {})), "2 drive");
  EXPECT_EQ(asked(run.take(error("blocked"), {})), "3 around");
  EXPECT_EQ(run.repairing(), "drive: as told");
  Answer around;
  around.energy_j = 5;
  const Step step = run.take(around, {});
  ASSERT_TRUE(step.end) << "nothing is called after it";
  EXPECT_EQ(step.end->error, "");
  EXPECT_EQ(step.end->values, (std::map<std::string, temporal::Value>{{"x", 2.0}}));
  EXPECT_EQ(step.end->energy_j, 15);
  EXPECT_EQ(run.repairing(), "");
  EXPECT_EQ(run.then(methods.rest), state("there"));

  MethodRun failed(methods.methods.at("Go"), {});
  failed.begin();
  failed.take(numbers({{"x", 2}}), {});
  failed.take(error("blocked"), {});
  const Step end = failed.take(error("stalled"), {});
  ASSERT_TRUE(end.end);
  EXPECT_EQ(end.end->error, "blocked") << "a repair that fails ends it as failed";
  EXPECT_EQ(end.end->energy_j, 20) << "what the failed repair drew counts, too";

  // What one process had taken another one comes to the end with.
  MethodRun again(methods.methods.at("Go"), {});
  EXPECT_EQ(asked(again.begin_after({{numbers({{"x", 2}}), {}}, {error("blocked"), {}}})), "3 around");
  EXPECT_TRUE(again.take({}, {}).end);
}

// What a call brought is gone when it is called again: its second answer may bring less, or nothing.
TEST(MethodRun, ARepeatedCallHasOnlyWhatItBroughtLast) {
  constexpr char kText[] = R"(
dedicated:
  timeline: t
  subsystem: s
  methods:
    Go:
      calls:
        - {name: way, command: {owner: o, subsystem: map, name: way}}
        - {name: drive, command: {owner: o, subsystem: nav, name: drive, arguments: {way: "{way.way}"}}}
      repairs:
        drive.no-go: {calls: [{name: pause, wait_s: 1}], then: way}
        way.blocked: {calls: [{name: anew, command: {owner: o, subsystem: nav, name: drive, arguments: {way: "{way.way}"}}}]}
)";
  const Methods methods = methods::read_methods(mission::Entry::parse(kText, "m").at("dedicated"));
  Answer closed_way;
  closed_way.values = {{"way", state("closed")}, {"length_m", 3.0}};
  const auto at_second_way = [&] {
    MethodRun run(methods.methods.at("Go"), {});
    run.begin();
    run.take(closed_way, {});
    run.take(error("no-go"), {});
    EXPECT_EQ(asked(run.take({}, {})), "4 way");
    return run;
  };
  MethodRun without = at_second_way();
  const Step step = without.take(numbers({{"length_m", 4}}), {});
  EXPECT_EQ(asked(step), "end wrong-value") << "the way that was just closed is not driven again";
  MethodRun failed = at_second_way();
  EXPECT_EQ(asked(failed.take(error("blocked"), {})), "end wrong-value")
      << "nor in a repair of the second call";
}

TEST(MethodRun, AnErrorThatIsNotRepairedAnyMoreStands) {
  MethodRun run(example().methods.at("Traverse"), {{"wp", "w3"}});
  run.begin();
  run.take({}, kRich);
  for (int repair = 0; repair < 2; ++repair) {
    run.take(error("no-go"), kRich);
    run.take({}, kRich);
    run.take({}, kRich);
    EXPECT_THAT(asked(run.take({}, kRich)), HasSubstr("drive"));
  }
  const Step step = run.take(error("no-go"), kRich);
  ASSERT_TRUE(step.end) << "at most two repairs";
  EXPECT_EQ(step.end->error, "no-go");
  EXPECT_EQ(run.failed({.error = "no-go"}, example().rest), state("hazard-detected", {"w3"}));
  EXPECT_EQ(run.failed({.error = "stalled"}, example().rest), state("failed"));
}

// What ends a drive of the scout of missions/faster says in which state its locomotion is left: only what its wheels, its
// cameras or its planner found is a hazard.
TEST(MethodRun, AnInterruptedDriveOfTheScoutIsNoHazard) {
  const Methods scout = methods::read_methods(
      mission::Entry::load(ROCI_SOURCE_DIR "/missions/faster/scout_locomotion.yaml").at("dedicated"));
  for (const auto& [name, place] : {std::pair("TraverseWithSS", "w3"), std::pair("ComeBack", "w2")}) {
    MethodRun run(scout.methods.at(name), {{"from", "w2"}, {"to", "w3"}});
    run.begin();
    for (const char* error :
         {"owner-lost", "no-answer", "call-timeout", "owner-restarted", "cancelled", "stopped"})
      EXPECT_EQ(run.failed({.error = error}, scout.rest), state("drive_interrupted", {place}))
          << name << error;
    for (const char* error : {"no-go", "blocked", "collision", "no-path", "path-invalid", "repair-overrun"})
      EXPECT_EQ(run.failed({.error = error}, scout.rest), state("hazard_detected", {place})) << name << error;
    for (const char* error : {"fault", "bogged-down"})
      EXPECT_EQ(run.failed({.error = error}, scout.rest), state("lost")) << name << error;
  }
}

TEST(MethodRun, ARepairMayShowAStateOfItsOwn) {
  const Methods methods = methods::read_methods(
      mission::Entry::parse(
          "dedicated: {timeline: t, subsystem: s, methods: {go: {arguments: [to], calls: [{name: a, wait_s: "
          "1}], "
          "repairs: {fault: {calls: [{name: b, wait_s: 1}], shows: [mending, \"{to}\"]}}}}}",
          "m")
          .at("dedicated"));
  MethodRun run(methods.methods.at("go"), {{"to", "x"}});
  run.begin();
  EXPECT_EQ(run.during(), state("go", {"x"}));
  run.take(error("fault"), {});
  EXPECT_EQ(run.during(), state("mending", {"x"}));
  run.take({}, {});
  EXPECT_EQ(run.during(), state("go", {"x"}));
}

TEST(MethodRun, WhatIsShownAndToldInTheEndMayBeOfOneCallsError) {
  const Methods methods = methods::read_methods(mission::Entry::parse(R"(
dedicated:
  timeline: t
  subsystem: s
  methods:
    go:
      arguments: [from, to]
      calls: [{name: a, wait_s: 1}, {name: b, wait_s: 1}]
      failed: {a.fault: [lost], fault: [weak], "*": [tired]}
      tells:
        done: {"way.{from}.{to}": [open]}
        b.fault: {"way.{from}.{to}": [closed, "{to}"], other: [seen]}
)",
                                                                      "m")
                                                    .at("dedicated"));
  const methods::Shown rest{"idle", {}};
  MethodRun first(methods.methods.at("go"), {{"from", "x"}, {"to", "y"}});
  first.begin();
  const End at_once = *first.take(error("fault"), {}).end;
  EXPECT_EQ(first.failed(at_once, rest), state("lost"));
  EXPECT_TRUE(first.told(at_once).empty());

  MethodRun second(methods.methods.at("go"), {{"from", "x"}, {"to", "y"}});
  second.begin();
  second.take({}, {});
  const End late = *second.take(error("fault"), {}).end;
  EXPECT_EQ(second.failed(late, rest), state("weak"));
  EXPECT_EQ(second.told(late), (std::map<std::string, temporal::Value>{{"way.x.y", state("closed", {"y"})},
                                                                       {"other", state("seen")}}));

  MethodRun third(methods.methods.at("go"), {{"from", "x"}, {"to", "y"}});
  third.begin();
  third.take({}, {});
  EXPECT_EQ(third.told(*third.take({}, {}).end),
            (std::map<std::string, temporal::Value>{{"way.x.y", state("open")}}));
}

// The one for a call goes before the one for any.
TEST(MethodRun, ARepairMayBeForOneCallAlone) {
  const Methods methods =
      methods::read_methods(mission::Entry::parse("dedicated: {timeline: t, subsystem: s, methods: {go: "
                                                  "{calls: [{name: a, wait_s: 1}, {name: b, wait_s: 1}], "
                                                  "repairs: {fault: {calls: [{name: any, wait_s: 1}]}, "
                                                  "a.fault: {calls: [{name: own, wait_s: 1}]}}}}}",
                                                  "m")
                                .at("dedicated"));
  MethodRun run(methods.methods.at("go"), {});
  run.begin();
  EXPECT_EQ(asked(run.take(error("fault"), {})), "2 own");
  EXPECT_EQ(asked(run.take({}, {})), "3 a");
  EXPECT_EQ(asked(run.take({}, {})), "4 b");
  EXPECT_EQ(asked(run.take(error("fault"), {})), "5 any");
  EXPECT_EQ(asked(run.take({}, {})), "6 b");
}

TEST(MethodRun, WithoutWhatItNeedsNothingIsRepaired) {
  for (const Observations& poor : {Observations{}, Observations{{"scout.battery", 99.0}}}) {
    MethodRun run(example().methods.at("Traverse"), {{"wp", "w3"}});
    run.begin();
    run.take({}, poor);
    EXPECT_EQ(asked(run.take(error("no-go"), poor)), "end no-go");
  }
}

TEST(MethodRun, AFailureWithinARepairIsToldWithBothReasons) {
  MethodRun run(example().methods.at("Traverse"), {{"wp", "w3"}});
  run.begin();
  run.take({}, kRich);
  run.take(error("no-go"), kRich);
  run.take({}, kRich);
  const Step step = run.take(error("no-path"), kRich);
  ASSERT_TRUE(step.end);
  EXPECT_EQ(step.end->error, "no-go") << "what is above knows this error";
  EXPECT_EQ(step.end->reason, "drive: as told; its repair failed in other: as told");
}

TEST(MethodRun, ARepairWithoutTimeLeavesTheError) {
  MethodRun run(example().methods.at("Traverse"), {{"wp", "w3"}});
  run.begin();
  run.take({}, kRich);
  run.take(error("no-go"), kRich);
  EXPECT_EQ(run.forbid_repair().error, "no-go");
  EXPECT_THAT(run.forbid_repair().reason, HasSubstr("no time to repair"));
}

TEST(MethodRun, NumbersBecomeTextThatReadsBackTheSame) {
  EXPECT_EQ(to_argument(0.1), "0.1");
  EXPECT_EQ(to_argument(-1e-7), "-1e-07");
  EXPECT_EQ(to_argument(state("idle-at", {"w1"})), "idle-at");
  EXPECT_EQ(to_argument(true), "true");
}

}  // namespace
}  // namespace roci::dedicated::method_run
