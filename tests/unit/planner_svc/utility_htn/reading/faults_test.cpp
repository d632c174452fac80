// What is wrong in a network file is told with file, line, column and remedy, all of it at once (R83).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/unit/planner_svc/utility_htn/reading/texts.hpp"

namespace roci::planner::utility_htn::reading {
namespace {

using testing::HasSubstr;

struct Case {
  std::string from, to, says;
};

TEST(NetworkFaults, AreToldWithPlaceAndRemedy) {
  const std::vector<Case> cases{
      {"battery: [{rate: -3}", "batery: [{rate: -3}",
       "n.yaml:29:15: unknown timeline 'batery'; did you mean 'battery'?"},
      {"sequence: [{task: \"dig_{site}\"}", "sequence: [{task: \"dug_{site}\"}",
       "n.yaml:45:59: unknown task 'dug_0'; did you mean 'dig_0'?"},
      {"again: [\"dig_{site}\"]", "again: []",
       "n.yaml:46:14: decomposition 'again' is empty; list its subtasks"},
      {"phase: {set: done}", "phase: {set: down}",
       "n.yaml:31:20: 'phase' has no state 'down'; known: landed, sampling, done"},
      {"arm: {take: 1}", "arm: {}", "n.yaml:30:12: expected one of set, add, take, rate"},
      {"arm: {take: 1}", "arm: {take: 1, at: end}", "what is taken is taken while the task runs"},
      {"\"phase != landed\"", "\"phase >= 3\"",
       "n.yaml:26:11: 'phase' has named states, not numbers; write 'phase = STATE' or"},
      {"\"battery >= 500\"", "\"battery = full\"",
       "'full' is no number; a constraint on numbers compares with a number"},
      {"\"battery >= 500\"", "\"battery > 500\"",
       "compares nothing; write '<=' or '>=': bounds are included"},
      {"\"battery >= 500\"", "\"battery != 500\"", "the values of 'battery' are numbers"},
      {"battery in 10 .. 20000", "battery in 20 .. 10",
       "no number lies within these bounds; write the lower one first"},
      {"2 * dig_s_{site} + 5", "2 * dug_s_{site} + 5",
       "unknown parameter 'dug_s_0'; did you mean 'dig_s_0'?"},
      {"2 * dig_s_{site} + 5", "dig_s_0 * dig_s_1", "two names in 'dig_s_0 * dig_s_1'"},
      {"2 * dig_s_{site} + 5", "2 * dig_s_{sight} + 5",
       "nothing stands for '{sight}'; known here: capacity_j, site"},
      {"initial: \"{capacity_j}\"", "initial: capacity_j",
       "'capacity_j' stands where only a number can; write \"{capacity_j}\""},
      {"analysis: 0.5", "analisis: 0.5", "unknown rank 'analisis'; did you mean 'analysis'?"},
      {"tier: decisional", "tier: decisive",
       "expected one of critical, decisional, mandatory, residual, not 'decisive'"},
      {"for: {site: sites}\n    batch", "for: {site: sights}\n    batch",
       "no set 'sights'; list the values, or name them under 'sets'"},
      {"batch: sampling", "batch: samples", "unknown batch 'samples'; known: outside, sampling"},
      {"  stow: {duration_s: 10}", "  dig_1: {duration_s: 10}",
       "there is a task 'dig_1' already, at n.yaml:22:5; rename one"},
      {"budget: battery", "budget: batery", "unknown timeline 'batery'; did you mean 'battery'?"},
      {"retries: 2", "retries: -2", "expected a whole number from 0 to 4294967295"},
      {"may_skip: true", "may_skip: maybe", "expected true or false"},
      {"wait_s: 60", "wait: 60", "unknown key 'wait'; known here: wait_s"},
      {"\"yield_{site}\": \"dig_s_{site}\"", "\"yield_{site}\": \"dug_s_{site}\"",
       "unknown parameter 'dug_s_0'; did you mean 'dig_s_0'?"},
      {"values: {\"yield_{site}\": \"dig_s_{site}\"}", "value: dig_s_0",
       "unknown key 'value'; known here: duration_s, energy, power, values; did you mean 'values'?"},
      {"stow: {duration_s: 10}", "stow: {duration_s: {site}}",
       "'{site}' without quotes is 'key: value' pairs; write \"{site}\""},
      {"stow: {duration_s: 10}", "stow: {duration_s: 1e999}", "expected a finite number"},
      {"stow: {duration_s: 10}", "stow: {window_s: [1]}", "expected [opens, closes]"},
      {"range: [10, 1000]", "range: 10", "expected a list"},
      {"kind: atomic", "kind: atom", "unknown kind 'atom'; known: atomic, state"},
      {"format: 1", "format: 2", "n.yaml:1:9: this form is newer than 1"},
      {"network: lander", "network: lander\ninclude: x.yaml",
       "a text that came without a folder includes no files"},
      {"commit_window_s: 20", "commit_window: 20", "'commit_window_s' is missing; add it"},
      {"ranks: [mission, analysis]", "ranks: [mission, mission]", "there is a rank 'mission' already"},
      {"[10, 1000]", "[10, 1000", "not valid YAML"},
  };
  for (const Case& c : cases)
    EXPECT_THAT(faults_of(with(kSound, c.from, c.to)), HasSubstr(c.says)) << c.from << " -> " << c.to;
}

TEST(NetworkFaults, AreToldAllAtOnceAndOnceForEachEntry) {
  std::string text = with(kSound, "battery: [{rate: -3}", "batery: [{rate: -3}");
  text = with(text, "arm: {take: 1}", "arm: {}");
  text = with(text, "stow: {duration_s: 10}", "stow: {duration: 10}");
  text = with(text, "budget: battery", "budget: b");
  const std::string all = faults_of(text);
  EXPECT_EQ(std::ranges::count(all, '\n'), 4) << all;
}

// A declaration that cannot be read, or is missing, makes no fault of what uses it.
TEST(NetworkFaults, OfADeclarationAreToldWithoutWhatStandsOnIt) {
  const std::vector<Case> cases{
      {"kind: atomic", "kind: atom", "unknown kind 'atom'"},
      {"states: [landed", "states: [lended", "'phase' has no state 'landed'"},
      {"sites: [0, 1]", "sites: {from: 1, to: 0}", "it ends before it begins"},
      {"sites: [0, 1]", "sights: [0, 1]", "no set 'sites'"},
      {"ranks: [mission, analysis]", "ranks: mission", "expected a list"},
      {"timelines:", "timeline:", "unknown key 'timeline'"},
      {"range: [10, 1000]", "range: 10", "expected a list"},
      {"capacity_j: {value:", "capacity_j: {valeu:", "unknown key 'valeu'"},
  };
  for (const Case& c : cases) {
    const std::string all = faults_of(with(kSound, c.from, c.to));
    EXPECT_THAT(all, HasSubstr(c.says)) << c.from << " -> " << c.to;
    EXPECT_LE(std::ranges::count(all, '\n'), c.to.starts_with("capacity_j") ? 2 : 1) << all;
  }
}

TEST(NetworkFaults, ANameThatNobodyKnowsIsToldOnceWithAllItsPlaces) {
  const std::string all = faults_of(with(kSound, "  battery: {kind", "  batery: {kind"));
  EXPECT_EQ(std::ranges::count(all, '\n'), 1) << all;
  EXPECT_THAT(all, HasSubstr("n.yaml:6:9: unknown timeline 'battery'; did you mean 'batery'?"));
  EXPECT_THAT(all, HasSubstr("; it stands in lines 26, 27, 29, 39, too"));
}

TEST(NetworkFaults, WhatIsMuchIsRefusedBeforeItIsMade) {
  EXPECT_THAT(faults_of(with(kSound, "sites: [0, 1]", "sites: {from: 0, to: 40000}")),
              HasSubstr("repetitions"));
  EXPECT_THAT(faults_of(with(kSound, "  stow: {duration_s: 10}",
                             "  stow: {for: {a: {from: 0, to: 9999}, b: {from: 0, to: 9999}}}")),
              HasSubstr("more than 40000 repetitions; make the lists shorter"));
  // One list of a thousand subtasks, by an alias in each of a thousand decompositions.
  std::string bomb = with(kSound, "again: [\"dig_{site}\"]", "again: &list [");
  std::string more;
  for (int i = 0; i < 1000; ++i) more += "stow, ";
  bomb = with(bomb, "&list [", "&list [" + more + "stow]");
  std::string aliases;
  for (int i = 0; i < 1000; ++i) aliases += "      way_" + std::to_string(i) + ": *list\n";
  bomb = with(bomb, "  uplink_{n}:", aliases + "  uplink_{n}:");
  EXPECT_THAT(faults_of(bomb), HasSubstr("items in the lists of all tasks; make the network smaller"));
}

TEST(NetworkFaults, ManyOfThemEndTheReading) {
  std::string text = kSound;
  for (int i = 0; i < 2000; ++i) text += "  bad_" + std::to_string(i) + ": {duration: 1}\n";
  const std::string all = faults_of(text);
  EXPECT_EQ(std::ranges::count(all, '\n'), 100);
}

}  // namespace
}  // namespace roci::planner::utility_htn::reading
