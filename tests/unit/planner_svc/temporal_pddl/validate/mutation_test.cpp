// A valid plan stays valid under changes that PDDL allows and is refused, for the right reason, after those
// it does not.
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/unit/planner_svc/temporal_pddl/validate/checking.hpp"

namespace roci::planner::temporal_pddl::validate {
namespace {

using ::testing::HasSubstr;

const World kRover = {
    "(:types place) (:constants home - place)"
    "(:predicates (at ?p - place) (road ?a ?b - place) (window) (idle) (photo ?p - place) (sent ?p - place))"
    "(:functions (battery) (length ?a ?b - place))"
    "(:durative-action drive :parameters (?a ?b - place) :duration (= ?duration (/ (length ?a ?b) 2))"
    " :condition (and (at start (at ?a)) (at start (road ?a ?b)) (over all (idle)) (at start (>= (battery) "
    "(length ?a ?b))))"
    " :effect (and (at start (not (at ?a))) (at start (decrease (battery) (length ?a ?b))) (at end (at ?b))))"
    "(:durative-action shoot :parameters (?p - place) :duration (= ?duration 4)"
    " :condition (and (over all (at ?p)) (at start (idle)))"
    " :effect (and (at start (not (idle))) (at end (idle)) (at end (photo ?p))))"
    "(:durative-action send :parameters (?p - place) :duration (and (>= ?duration 3) (<= ?duration 6))"
    " :condition (and (at start (photo ?p)) (over all (window))) :effect (at end (sent ?p)))",
    "(:objects rock hill - place) (:init (at home) (idle) (road home rock) (road rock home) (road rock hill)"
    " (= (battery) 40) (= (length home rock) 20) (= (length rock home) 20) (= (length rock hill) 30)"
    " (at 16 (window)) (at 22 (not (window)))) (:goal (and (sent rock) (at home)))",
    ""};

const std::string kPlan =
    "0: (drive home rock) [10]\n"
    "10.001: (shoot rock) [4]\n"
    "16: (send rock) [5]\n"
    "14.002: (drive rock home) [10]\n";

std::string replaced(std::string from, const std::string& what, const std::string& by) {
  const std::size_t place = from.find(what);
  EXPECT_NE(place, std::string::npos) << what;
  return from.replace(place, what.size(), by);
}

TEST(Mutation, TheOriginalIsValid) { EXPECT_EQ(check_kinds(kRover, kPlan), ""); }

struct Mutation {
  std::string what;
  std::string by;
  std::string expected;  // a part of kinds(); empty: still valid
};

TEST(Mutation, OfTimes) {
  const std::vector<Mutation> mutations = {
      {"10.001: (shoot", "10: (shoot", ""},  // at rock is asked over all only, from 10 on
      {"10.001: (shoot", "9.999: (shoot", "invariant@9.999"},
      {"14.002: (drive", "14.001: (drive", ""},  // idle again at 14.001, and asked over all
      {"14.002: (drive", "14: (drive", "invariant@14.000"},
      {"16: (send", "15.999: (send", "invariant@15.999"},
      {"16: (send", "17: (send", ""},  // until 22, when the window closes
      {"16: (send", "17.001: (send", "invariant@22.000"},
      {"16: (send", "14.001: (send", "condition@14.001"},
      {"0: (drive", "0.5: (drive", "invariant@10.001"},
      {"14.002: (drive", "100: (drive", ""},
  };
  for (const Mutation& mutation : mutations) {
    const std::string kinds = check_kinds(kRover, replaced(kPlan, mutation.what, mutation.by));
    if (mutation.expected.empty()) {
      EXPECT_EQ(kinds, "") << mutation.by;
    } else {
      EXPECT_THAT(kinds, HasSubstr(mutation.expected)) << mutation.by;
    }
  }
}

TEST(Mutation, OfDurationsAndArguments) {
  const std::vector<Mutation> mutations = {
      {"(drive home rock) [10]", "(drive home rock) [9.9]", "time@0.000"},
      {"(drive home rock) [10]", "(drive home rock) [10.0004]", ""},
      {"(send rock) [5]", "(send rock) [6]", ""},
      {"(send rock) [5]", "(send rock) [3]", ""},
      {"(send rock) [5]", "(send rock) [2.9]", "time@16.000"},
      {"(send rock) [5]", "(send rock) [6.1]", "time@16.000"},
      {"(drive rock home)", "(drive home rock)", "condition@14.002"},
      {"(drive rock home) [10]", "(drive rock hill) [15]", "condition@14.002"},  // battery
      {"(shoot rock)", "(shoot home)", "invariant@10.001"},
      {"(send rock)", "(send hill)", "condition@16.000"},
      {"(send rock)", "(send idle)", "wrong arguments@16.000"},
  };
  for (const Mutation& mutation : mutations) {
    const std::string kinds = check_kinds(kRover, replaced(kPlan, mutation.what, mutation.by));
    if (mutation.expected.empty()) {
      EXPECT_EQ(kinds, "") << mutation.by;
    } else {
      EXPECT_THAT(kinds, HasSubstr(mutation.expected)) << mutation.by;
    }
  }
}

TEST(Mutation, EveryStepIsNeeded) {
  const auto plan = pddl::parse_plan(kPlan, "plan");
  for (std::size_t i = 0; i < plan.size(); ++i) {
    auto shorter = plan;
    shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_FALSE(check_plan(kRover, pddl::print_plan(shorter)).valid) << "without step " << i;
  }
}

TEST(Mutation, OrderOfLinesDoesNotMatter) {
  auto plan = pddl::parse_plan(kPlan, "plan");
  std::mt19937_64 random(1);
  for (int i = 0; i < 24; ++i) {
    std::shuffle(plan.begin(), plan.end(), random);
    EXPECT_EQ(check_kinds(kRover, pddl::print_plan(plan)), "");
  }
}

TEST(Mutation, ExchangedStartsAreRefused) {
  const auto plan = pddl::parse_plan(kPlan, "plan");
  for (std::size_t i = 0; i < plan.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      auto mutated = plan;
      std::swap(mutated[i].start, mutated[j].start);
      EXPECT_FALSE(check_plan(kRover, pddl::print_plan(mutated)).valid) << i << " and " << j;
    }
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::validate
