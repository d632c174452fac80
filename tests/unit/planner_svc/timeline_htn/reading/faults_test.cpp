// What is wrong in a model is told with file, line, column and remedy, all of it at once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/planner_svc/timeline_htn/reading/texts.hpp"
#include "tests/unit/planner_svc/timeline_htn/reading/windows.hpp"

namespace roci::planner::timeline_htn::reading {
namespace {

using testing::HasSubstr;

struct Case {
  std::string from, to, says;
};

void expect_faults(const std::vector<Case>& cases) {
  for (const Case& c : cases)
    EXPECT_THAT(faults_of(with(kSound, c.from, c.to)), HasSubstr(c.says)) << c.from << " -> " << c.to;
}

TEST(TimelineModelFaults, NamesAreToldWithPlaceAndRemedy) {
  expect_faults({
      {"drive: wheels.drive(from, to)", "drive: weels.drive(from, to)",
       "m.yaml:46:14: unknown component 'weels'; did you mean 'wheels'?"},
      {"drive: wheels.drive(from, to)", "drive: wheels.driv(from, to)",
       "m.yaml:46:14: unknown state 'driv'; did you mean 'drive'?"},
      {"there: {state: \"navigation.traverse(wp0, wp1)\"", "there: {state: \"navigaton.traverse(wp0, wp1)\"",
       "unknown component 'navigaton'; did you mean 'navigation'?"},
      {"wheels: at(wp0)", "wheels: at(wp9)",
       "'wp9' is no variable here and no waypoint; did you mean 'wp0'?"},
      {"wheels: at(wp0)", "wheels: at(status)", "'status' is of type report, and a waypoint is wanted"},
      {"wheels: at(wp0)", "wheels: at", "'at' has 1 arguments, not 0; write as many"},
      {"wheels: at(wp0)", "wheel: at(wp0)", "unknown component 'wheel'; did you mean 'wheels'?"},
      {"report: [status]", "reprt: [status]", "unknown type 'reprt'; did you mean 'report'?"},
      {"report: [status]", "report: [wp0]", "there is an object 'wp0' already, at m.yaml:4:22; rename one"},
      {"edge(from, to)", "egde(from, to)",
       "'egde' is no relation, number, variable or object here; did you mean 'edge'?"},
      {"  idle: {kind: default}", "  idle: {kind: defalt}",
       "m.yaml:13:20: expected one of complex, simple, error, default, not 'defalt'; did you mean "
       "'default'?"},
      {"layer: abstract", "layer: high", "expected one of abstract, primitive, not 'high'"},
      {"drive before tell", "drive before tel", "unknown subgoal 'tel'; did you mean 'tell'?"},
      {"drive before tell [0, 60]", "drive after tell", "expected one of before, meets, starts"},
      {"after: [there]", "after: [their]", "unknown goal 'their'; known: there, told"},
      {"binds: what", "binds: wat", "'wat' is no variable of the behaviour"},
      {"resolver: ground", "resolver: grund", "expected one of engine, ground, rule, not 'grund'"},
      {"retries: 2", "retry: 2", "unknown key 'retry'"},
      {"unstick:", "step:", "there is a behaviour 'step' already, at"},
      {"achieves: navigation.traverse(from, to)", "achieves: wheels.drive(from, to)",
       "'wheels.drive' is simple, and a behaviour achieves a complex state; name one"},
      {"achieves: navigation.traverse(from, to)", "achieves: navigation.idle",
       "'navigation.idle' is default, and a behaviour achieves a complex state; known: traverse"},
      {"wheels: at(wp0)", "wheels: at(elsewhere)",
       "'elsewhere' is no variable here and no waypoint; known: wp0, wp1"},
  });
}

// What a component has beside its fault is known, so that nobody is told that its states are missing.
TEST(TimelineModelFaults, AComponentOfAnUnknownLayerHasItsStates) {
  const std::string faults = faults_of(with(kSound, "layer: primitive", "layer: primitiv"));
  EXPECT_THAT(faults,
              HasSubstr("expected one of abstract, primitive, not 'primitiv'; did you mean 'primitive'?"));
  EXPECT_THAT(faults, testing::Not(HasSubstr("unknown state")));
}

// What is declared with such a type has its name and as many arguments, so that nobody is told to mend where it is used.
TEST(TimelineModelFaults, AnUnknownTypeIsTheOneFaultOfWhatIsDeclaredWithIt) {
  const std::string drive = "parameters: {from: waypoint, to: waypoint}\n        where";
  const std::vector<Case> cases{
      {"{place: waypoint}, observed", "{place: waypont}, observed", "m.yaml:20:47: "},
      {drive, with(drive, "to: waypoint", "to: waypont"), "m.yaml:23:42: "},
      {"complex, parameters: {from: waypoint", "complex, parameters: {from: waypont", "m.yaml:14:52: "},
      {"edge: {arguments: [waypoint, waypoint]", "edge: {arguments: [waypoint, waypont]", "m.yaml:6:32: "},
      {"metres: {arguments: [waypoint, waypoint]", "metres: {arguments: [waypont, waypoint]",
       "m.yaml:8:24: "},
      {"objects: {waypoint: [wp0", "objects: {waypont: [wp0", "m.yaml:4:20: "},
  };
  for (const Case& c : cases)
    EXPECT_EQ(faults_of(with(kSound, c.from, c.to)),
              c.says + "unknown type 'waypont'; did you mean 'waypoint'? else known: report, waypoint\n");
}

TEST(TimelineModelFaults, NumbersThatServicesAreAskedForAreToldWithPlaceAndRemedy) {
  const std::string table = "metres: {arguments: [waypoint, waypoint], rows: [[wp0, wp1, 4], [wp1, wp0, 5]]}";
  const auto asked = [&](const std::string& with) {
    return Case{table, "metres: {arguments: [waypoint, waypoint], asked: {" + with, ""};
  };
  const auto expect = [&](const std::string& with, const std::string& says) {
    Case one = asked(with);
    one.says = says;
    expect_faults({one});
  };
  expect("module: paths, rows_of: edge}, rows: [[wp0, wp1, 4]]}",
         "m.yaml:8:90: a service is asked for the numbers of 'metres', at m.yaml:8:52; take this out, or "
         "'asked'");
  expect("module: paths}, symmetric: true}", "take this out, or 'asked'");
  expect("function: metres}}", "'module'");
  expect("module: paths, rows_of: edg}}", "unknown relation 'edg'; did you mean 'edge'?");
  expect("module: paths, rows: edge}}", "unknown key 'rows'");
  expect_faults(
      {{table, "metres: {arguments: [waypoint], asked: {module: paths, rows_of: edge}}",
        "relation 'edge' is of other types than 'metres'; name one with the same arguments, or none"}});
  EXPECT_THAT(faults_of(with(kSound, table, asked("module: paths, rows_of: edge}}").to)), testing::IsEmpty())
      << "of states whose numbers are still to come nothing is said";
}

TEST(TimelineModelFaults, NumbersAndLinesAreToldWithPlaceAndRemedy) {
  expect_faults({
      {"[[wp0, wp1, 4]", "[[wp0, wp1, far]", "expected a finite number, not 'far'"},
      {"[[wp0, wp1, 4]", "[[wp0, wp1, .inf]", "expected a finite number"},
      {"[[wp0, wp1, 4]", "[[wp0, 4]", "the row has 2 entries, 3 are expected"},
      {"[[wp0, wp1, 4]", "[[wp1, wp0, 4]", "the table has another number for these objects already"},
      {"metres(from, to) / 0.5", "metres(from, to) / ", "expected a name at the end"},
      {"metres(from, to) / 0.5", "metres(from, to) / 0", "nothing can be divided by 0; mend the number"},
      {"metres(from, to) / 0.5", "metres(from, to / 0.5", "expected ')' before '/ 0.5'"},
      {"there: {state: \"navigation.traverse(wp0, wp1)\"", "there: {state: navigation.traverse(wp0, wp1)",
       "inside of [ ] and { } put quotes round what has a comma"},
      {"metres(from, to) / 0.5", "metres(from, to) / 1e999", "expected a finite number"},
      {"metres(from, to) / 0.5", "metres(from, to) 5", "'5' stands where the line should end"},
      {"metres(from, to) / 0.5\", ", "none\", none, ", "expected one duration, or [shortest, longest]"},
      {"answer_within_s: 5", "answer_within_s: 0", "expected seconds above 0"},
      {"goal: to", "goal: to.", "'to.' names no property; write one behind the dot, or drop the dot"},
      {"window_s: [5, 300]", "window_s: [5]", "expected [opens, closes]"},
      {"window_s: [5, 300]", "release_s: none", "a goal is released at some time"},
      {"horizon_s: 600", "horizon_s: none", "a plan ends at some time"},
      {"horizon_s: 600", "horizon_s: 1e300", "expected seconds from the origin on"},
      {"retries: 2", "retries: -1", "expected a whole number from 0 to 1000"},
      {"kind: default}\n      traverse", "kind: default, duration_s: 5}\n      traverse",
       "a default state lasts as long as nothing else is asked"},
      {"kind: complex, ", "kind: complex, duration_s: 5, ", "a complex state has no 'duration_s'"},
      {"format: 1", "format: 2", "m.yaml:1:9: this form is newer than 1"},
      {"format: 1", "include: x.yaml",
       "m.yaml:1:10: a text that came without a folder includes only what came with it"},
      {"[wp0, wp1]]}\nnumbers", "[wp0, wp1]}\nnumbers", "not valid YAML"},
  });
}

TEST(TimelineModelFaults, WhatContradictsItselfIsToldAtItsPart) {
  expect_faults({
      {"initial: {navigation: idle, wheels: at(wp0), antenna: stowed}",
       "initial: {navigation: idle, antenna: stowed}",
       "m.yaml:57:3: the problem does not say in which state 'wheels' begins; add it under 'initial'"},
      {"wheels: at(wp0)", "wheels: \"drive(wp0, wp0)\"", "there is no state wheels.drive(wp0, wp0)"},
      {"navigation: idle", "navigation: \"traverse(wp0, wp1)\"", "'navigation' begins in a complex state"},
      {"told: {state: antenna.send(status), after: [there]}", "told: {state: wheels.stuck(wp0)}",
       "goal 'told': it asks for an error state"},
      {"window_s: [5, 300]", "window_s: [300, 5]", "goal 'there': its window closes before it opens"},
      {"window_s: [5, 300]", "window_s: [900, none]", "its window opens after the horizon, 600 s"},
      {"window_s: [5, 300]", "window_s: [5, 300], release_s: 301", "its window closes before 'release_s'"},
      {"window_s: [5, 300]", "release_s: 601", "it is released after the horizon, 600 s"},
      {"window_s: [5, 300]", "after: [told]", "goal 'there': it comes after itself"},
      {"antenna.send(what), contingency: silence", "wheels.stuck(to)",
       "its subgoal 'tell' is an error state"},
      {"drive: wheels.drive(from, to)", "drive: navigation.idle",
       "its subgoal 'drive' is a state of the very component that it stands on"},
      {"kind: default}\n      traverse", "kind: error}\n      traverse",
       "m.yaml:11:5: component 'navigation': it has no state to rest in"},
      {"\"drive(x, y) -> at(y)\", ", "", "m.yaml:22:9: state 'wheels.drive': nothing can follow it"},
      {"stuck(x) -> at(x)", "at(x) -> drive(x, x)", ""},
      {"layer: primitive\n    robot", "layer: abstract\n    robot",
       "it has a command, and its component is abstract"},
      {"duration_s: 10", "duration_s: [10, 5]", "state 'antenna.send': its duration is negative"},
      {"choices: {a: {subgoals: tell", "choices: {a: {subgoals: other", "stands in two choices"},
  });
}

TEST(TimelineModelFaults, WhatStaysOpenHasNoPropertiesYet) {
  expect_faults(
      {{"what: report}, duration_s: 10}",
        "what: report}, duration_s: 10, command: {owner: sim, command: send, arguments: {size: what.size}}}",
        "'what.size' of the command send is a property of what stays open"}});
}

TEST(TimelineModelFaults, PredictedStatesThatCannotBeAreNamed) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& says) {
    EXPECT_THAT(faults_of(with(kWindows, from, to)), HasSubstr(says)) << from << " -> " << to;
  };
  EXPECT_EQ(faults_of(kWindows), "");
  expect("at_s: 600", "at_s: 130",
         "m.yaml:34:16: two states of 'ground' are predicted for one time; keep one");
  expect("at_s: 600", "at_s: 110",
         "m.yaml:34:16: predicted states stand in order of time; put this one before that at 130 s");
  expect("at_s: 100", "at_s: 0", "m.yaml:32:16: a predicted state comes at some time behind the origin");
  expect("at_s: 100", "at_s: none", "a predicted state comes at some time behind the origin");
  expect("at_s: 100", "at_s: -5", "expected seconds from the origin on");
  expect("100, state: seen", "100, state: sen", "m.yaml:32:28: unknown state 'sen'; did you mean 'seen'?");
  expect("100, state: seen", "100, state: hidden", "m.yaml:32:28: it is in this state already");
  expect("130, state: hidden", "130, state: seen", "m.yaml:33:28: it is in this state already");
  expect("100, state: seen", "100, stat: seen", "unknown key 'stat'");
  expect("    ground:\n      - {at", "    grond:\n      - {at",
         "unknown component 'grond'; did you mean 'ground'?");
  expect("hidden: {kind: default,", "hidden: {kind: error,",
         "'hidden' is a state of kind error; only default states without needs can be predicted");
  expect("value: false}}", "value: false}, needs: [during antenna.silent]}",
         "'hidden' is a state with needs; only default states without needs can be predicted");
  expect(
      "subgoals: {send: antenna.sending(what)}", "subgoals: {send: antenna.sending(what), see: ground.seen}",
      "m.yaml:32:7: behaviour 'tell' sets 'ground' by its subgoal 'see', and a plan changes nothing that is "
      "predicted; write a condition or a need instead");
  expect("one: mission.told(first)", "one: ground.seen",
         "goal 'one': it asks for a state of 'ground', which is predicted");
  expect("[hidden <-> seen]", "[seen -> hidden]",
         "m.yaml:32:7: no transition leads from ground.hidden to ground.seen, which is predicted behind it");
  expect("seen: {kind: default,", "seen: {kind: default, duration_s: [40, none],",
         "ground.seen is predicted for 30 s, and lasts 40 s at least");
  std::string many;
  for (int i = 1; i <= 1001; ++i)
    many += "      - {at_s: " + std::to_string(i) + ", state: " + (i % 2 == 0 ? "hidden" : "seen") + "}\n";
  const std::size_t from = kWindows.find("      - {at_s: 100"), to = kWindows.find("  goals: {one");
  EXPECT_THAT(faults_of(std::string(kWindows).replace(from, to - from, many)), HasSubstr("1000"));
}

TEST(TimelineModelFaults, BehavioursThatNeverEndAreNamed) {
  expect_faults({
      {"drive: wheels.drive(from, to)", "drive: \"navigation.traverse(from, to)\"",
       "behaviour 'step': it never ends: it needs navigation.traverse(from, to) to achieve just that"},
      {"drive: wheels.drive(from, to)", "drive: \"navigation.traverse(to, from)\"",
       "behaviour 'step': it never ends: it needs navigation.traverse(from, to)"},
      {"drive: wheels.drive(from, to)", "drive: \"navigation.traverse(to, to)\"",
       "behaviour 'step': it never ends: every behaviour for navigation.traverse(from, to) needs it again"},
      {"free: wheels.at(place)}",
       "free: \"navigation.traverse(place, place)\"}\n  step2: {achieves: \"navigation.traverse(x, y)\", "
       "subgoals: {a: \"navigation.traverse(wp0, y)\"}}",
       ""},
  });
}

TEST(TimelineModelFaults, BehavioursThatContradictThemselvesInTimeAreNamed) {
  expect_faults({
      {"drive before tell [0, 60]", "drive before tell before drive",
       "behaviour 'step': it contradicts itself in time: drive.start cannot be"},
      {"drive before tell [0, 60]", "tell.start to tell.end [0, 5]",
       "it contradicts itself in time: tell.end"},
      {"drive before tell [0, 60]", "tell.start to self.end [0, 9]",
       "it contradicts itself in time: self.end"},
  });
}

// A time beyond 64 bits of microseconds would be any number.
TEST(TimelineModelFaults, ATimeBetweenSubgoalsIsBounded) {
  const std::string remedy =
      " is no number, or beyond 1000000000 s (31 years); write a smaller one, or 'none'";
  expect_faults({
      {"drive before tell [0, 60]", "drive before tell [0, 1e13]",
       "m.yaml:40:5: behaviour 'step': a bound of the time from drive.end to tell.start" + remedy},
      {"drive before tell [0, 60]", "drive before tell [-1e15, none]",
       "a bound of the time from drive.end to tell.start" + remedy},
      {"drive before tell [0, 60]", "self.start to tell.end [0, 1000000001]",
       "a bound of the time from self.start to tell.end" + remedy},
      {"drive before tell [0, 60]", "drive before tell [0, 1 / (1 - 1)]", remedy},
  });
  for (const char* bounds : {"[0, 1000000000]", "[-1000000000, none]"})
    EXPECT_THAT(faults_of(with(kSound, "tell [0, 60]", std::string("tell ") + bounds)), testing::IsEmpty());
}

TEST(TimelineModelFaults, AreToldAllAtOnce) {
  std::string text = with(kSound, "drive: wheels.drive(from, to)", "drive: weels.drive(from, to)");
  text = with(text, "retries: 2", "retries: x");
  text = with(text, "wheels: at(wp0)", "wheels: at(wp9)");
  text = with(text, "[[wp0, wp1, 4]", "[[wp0, wp1, far]");
  const std::string all = faults_of(text);
  EXPECT_GE(std::ranges::count(all, '\n'), 4) << all;
}

TEST(TimelineModelFaults, WhatIsMuchIsRefusedBeforeItIsMade) {
  std::string rows;
  for (int i = 0; i < 1000; ++i) rows += "[wp0, wp1], ";
  std::string tables = with(kSound, "rows: [[wp0, wp1]]", "rows: &rows [" + rows + "[wp0, wp1]]");
  std::string more;
  for (int i = 0; i < 300; ++i)
    more += "  e" + std::to_string(i) + ": {arguments: [waypoint, waypoint], rows: *rows}\n";
  tables = with(tables, "numbers:\n", more + "numbers:\n");
  const std::string told = faults_of(tables);
  EXPECT_THAT(told, testing::AnyOf(HasSubstr("rows in all tables"), HasSubstr("tables of this kind")));
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "[";
  EXPECT_THAT(faults_of(with(kSound, "[waypoint, report]", deep)), HasSubstr("not valid YAML"));
  std::string brackets;
  for (int i = 0; i < 900; ++i) brackets += "(";
  EXPECT_THAT(faults_of(with(kSound, "metres(from, to) / 0.5", brackets)),
              HasSubstr("expected a name at the end"));
  EXPECT_THAT(faults_of(with(kSound, "metres(from, to) / 0.5", std::string(5000, 'x'))),
              HasSubstr("the line is longer than 1000 bytes"));
  EXPECT_THAT(faults_of(std::string(9U << 20U, ' ')), HasSubstr("make it smaller"));
}

}  // namespace
}  // namespace roci::planner::timeline_htn::reading
