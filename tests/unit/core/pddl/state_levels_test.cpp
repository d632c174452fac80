// Functions of the state are read as functions with a level for a parameter, and actions that say when it holds.
#include "core/pddl/state_levels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/check.hpp"
#include "core/pddl/parser.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {
namespace {

using ::testing::HasSubstr;

std::string domain(const std::string& types, const std::string& constants, const std::string& function,
                   const std::string& drive, const std::string& more = "") {
  return "(define (domain d) (:requirements :typing :durative-actions :numeric-fluents :equality "
         ":disjunctive-preconditions :negative-preconditions) (:types place rover " +
         types + ") " + constants +
         " (:predicates (at ?r - rover ?p - place)) (:functions (battery ?r - rover) (heat))" +
         "(:modules (:module roads " + function + "))" + drive + more + ")";
}

constexpr const char* kDependent =
    "(:function (time ?r - rover ?a ?b - place) :depends-on ((battery ?r) 0 20.5))";
constexpr const char* kDrive = R"((:durative-action drive :parameters (?r - rover ?a ?b - place)
    :duration (= ?duration (time ?r ?a ?b)) :condition (at start (at ?r ?a))
    :effect (and (at start (not (at ?r ?a))) (at end (at ?r ?b)) (at end (decrease (battery ?r) (time ?r ?a ?b))))))";

TEST(StateLevels, ALevelIsAParameterThatHoldsAtTheStart) {
  const Domain read = load_domain(domain("", "", kDependent, kDrive), "d");
  const Domain by_hand = load_domain(
      domain("battery-level - object", "(:constants battery-0 battery-20.5 - battery-level)",
             "(:function (time ?r - rover ?a ?b - place ?battery-level3 - battery-level))",
             R"((:durative-action drive :parameters (?r - rover ?a ?b - place ?battery-level - battery-level)
    :duration (= ?duration (time ?r ?a ?b ?battery-level))
    :condition (and (at start (at ?r ?a))
      (at start (or (and (= ?battery-level battery-0) (>= (battery ?r) 0) (< (battery ?r) 20.5))
                    (and (= ?battery-level battery-20.5) (>= (battery ?r) 20.5)))))
    :effect (and (at start (not (at ?r ?a))) (at end (at ?r ?b))
      (at end (decrease (battery ?r) (time ?r ?a ?b ?battery-level))))))"),
      "d");
  EXPECT_EQ(print(read), print(by_hand));
  EXPECT_TRUE(check(read).empty());
  ASSERT_EQ(read.level_parameters.size(), 1U);
  EXPECT_EQ(read.level_parameters[0].fluent, "battery");
  EXPECT_EQ(read.level_parameters[0].arguments, (std::vector<std::size_t>{0}));
  EXPECT_EQ(read.level_parameters[0].levels.at("battery-20.5"), 20.5);
}

TEST(StateLevels, AnActionThatReadsNoSuchFunctionStaysAsItIs) {
  const char* wait =
      "(:action rest :parameters (?r - rover) :precondition (>= (heat) 1) :effect (decrease (heat) 1))";
  const Domain read = load_domain(domain("", "", kDependent, kDrive, wait), "d");
  ASSERT_EQ(read.actions.size(), 1U);
  EXPECT_EQ(read.actions[0].parameters.size(), 1U);
}

TEST(StateLevels, ADeclarationIsPrintedAsItIsRead) {
  const Domain parsed = parse_domain(domain("", "", kDependent, kDrive), "d");
  EXPECT_THAT(print(parsed), HasSubstr(":depends-on ((battery ?r) 0 20.5)"));
  EXPECT_EQ(parse_domain(print(parsed), "printed"), parsed);
}

struct Wrong {
  const char* function;
  const char* message;
};

TEST(StateLevels, WhatIsWrongIsNamed) {
  const std::vector<Wrong> cases = {
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((charge ?r) 0))", "'charge' is no fluent"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((battery) 0))", "'battery' has 1 arguments"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((battery ?x) 0))",
       "must be parameters of the function"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((battery ?r)))", "a fluent with its levels expected"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((battery ?r) 5 5))", "levels must ascend"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on)", "an external function expected"},
      {"(:function (time ?r - rover ?a ?b - place) :depends ((heat) 0))", "':depends-on' expected"},
      {"(:function (time ?r - rover ?a ?b - place) :depends-on ((heat) 0)) (:function (cost) :depends-on "
       "((heat) 1))",
       "'heat' has other levels above"},
  };
  for (const Wrong& wrong : cases) {
    SCOPED_TRACE(wrong.function);
    try {
      load_domain(domain("", "", wrong.function, kDrive), "d");
      ADD_FAILURE() << "accepted";
    } catch (const ParseError& error) {
      EXPECT_THAT(error.what(), HasSubstr(wrong.message));
    }
  }
}

TEST(StateLevels, AFunctionOfTheStateStandsInActionsAlone) {
  const Domain read = load_domain(domain("", "", kDependent, kDrive), "d");
  try {
    load_problem(
        "(define (problem p) (:domain d) (:objects r - rover a b - place) (:init (at r a) (= (battery r) 9)) "
        "(:goal (and (at r b) (<= (time r a b) 3))))",
        "p", read);
    ADD_FAILURE() << "accepted";
  } catch (const ParseError& error) {
    EXPECT_THAT(error.what(), HasSubstr("'time' depends on the state, and has no value for the whole plan"));
  }
}

}  // namespace
}  // namespace roci::pddl
