// Each text is refused at the right place with the right words, and with a remedy. What tolerant reading takes with a
// warning (departures_test.cpp) is refused so by strict reading.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pddl/sexpr.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

enum class Kind { domain, problem };

void parse(Kind kind, const std::string& text, Strictness strictness) {
  if (kind == Kind::domain) {
    parse_domain(text, "some.pddl", strictness);
  } else {
    parse_problem(text, "some.pddl", strictness);
  }
}

void expect_refused(const std::string& text, SourceLocation where, const std::string& words, Kind kind,
                    Strictness strictness) {
  SCOPED_TRACE(text);
  try {
    parse(kind, text, strictness);
    FAIL() << "accepted";
  } catch (const ParseError& error) {
    EXPECT_EQ(error.file(), "some.pddl");
    EXPECT_EQ(error.line(), where.line);
    EXPECT_EQ(error.column(), where.column);
    EXPECT_THAT(error.diagnostic().message, HasSubstr(words));
    EXPECT_FALSE(error.diagnostic().remedy.empty());
    EXPECT_THAT(error.what(), StartsWith("some.pddl:" + std::to_string(where.line) + ":"));
  }
}

struct Refused {
  std::string text;
  SourceLocation where;
  std::string words;
  bool tolerated = false;
};

void expect_refused(const Refused& refused, Kind kind) {
  expect_refused(refused.text, refused.where, refused.words, kind, Strictness::strict);
  if (refused.tolerated) {
    EXPECT_NO_THROW(parse(kind, refused.text, Strictness::tolerant)) << refused.text;
  } else {
    expect_refused(refused.text, refused.where, refused.words, kind, Strictness::tolerant);
  }
}

TEST(ParseErrors, OfTheSkeleton) {
  const std::vector<Refused> cases = {
      {"", {1, 1}, "empty"},
      {"; only a comment", {1, 17}, "empty"},
      {"word", {1, 1}, "outside"},
      {")", {1, 1}, "')' without '('"},
      {"(define\n  (domain d)", {1, 1}, "never closed"},
      {"(define (domain d)\n (:types a", {2, 2}, "never closed"},
      {"(define (domain d)) x", {1, 21}, "after the end", true},
      {"(define (domain d)\n \x01)", {2, 2}, "0x01"},
      {"(define (domain caf\xc3\xa9))", {1, 20}, "0xc3"},
      {std::string(kMaxNesting + 1, '('), {1, kMaxNesting + 1}, "nested deeper"},
  };
  for (const Refused& c : cases) expect_refused(c, Kind::domain);
}

TEST(ParseErrors, OfSections) {
  const std::vector<Refused> cases = {
      {"(foo)", {1, 1}, "not a PDDL definition"},
      {"(define)", {1, 1}, "not a domain"},
      {"(define (problem p))", {1, 9}, "not a domain"},
      {"(define (domain ?d))", {1, 17}, "variable"},
      {"(define (domain d)\n(:axiom))", {2, 1}, "unknown section"},
      {"(define (domain d) x)", {1, 20}, "unknown section"},
      {"(define (domain d) (:constraints (p)))", {1, 20}, "trajectory constraints"},
      {"(define (domain d) (:process x))", {1, 20}, "PDDL+"},
      {"(define (domain d) (:event x))", {1, 20}, "PDDL+"},
      {"(define (domain d) (:requirements :typing :foo))", {1, 43}, "unknown requirement :foo", true},
      {"(define (domain d) (:requirements :preferences))", {1, 35}, ":preferences is not supported", true},
      {"(define (domain d) (:requirements :object-fluents))",
       {1, 35},
       ":object-fluents is not supported",
       true},
      {"(define (domain d) (:requirements (x)))", {1, 35}, "a list"},
      {"(define (domain d) (:types a -))", {1, 30}, "without a type"},
      {"(define (domain d) (:types - a))", {1, 28}, "without a name"},
      {"(define (domain d) (:types a - (or b c)))", {1, 32}, "a type expected"},
      {"(define (domain d) (:types a - (either)))", {1, 32}, "a type expected"},
      {"(define (domain d) (:types (a)))", {1, 28}, "found a list"},
      {"(define (domain d) (:predicates p))", {1, 33}, "'p'"},
      {"(define (domain d) (:predicates ()))", {1, 33}, "found ()"},
      {"(define (domain d) (:predicates (p x)))", {1, 36}, "variable expected, found 'x'"},
      {"(define (domain d) (:predicates (p ?)))", {1, 36}, "variable expected"},
      {"(define (domain d) (:functions (f) - place))", {1, 38}, "object fluents"},
      {"(define (domain d) (:functions (f) -))", {1, 36}, "without a type"},
      {"(define (domain d) (:modules (m)))", {1, 30}, "module expected"},
      {"(define (domain d) (:modules (:module m (f))))", {1, 41}, "external function"},
      {"(define (domain d) (:derived (p)))", {1, 20}, "head and a body"},
  };
  for (const Refused& c : cases) expect_refused(c, Kind::domain);
}

// The text stands on line 7, from column 1.
void expect_section_refused(const std::string& section, int column, const std::string& words) {
  expect_refused({domain_text(section), {7, column}, words}, Kind::domain);
}

TEST(ParseErrors, OfActions) {
  expect_section_refused("(:action)", 1, "without a name");
  expect_section_refused("(:action a :foo ())", 12, "':foo'");
  expect_section_refused("(:action a :effect)", 12, "without a value");
  expect_section_refused("(:action a :effect () :effect ())", 23, "twice");
  expect_section_refused("(:action a :effect p)", 20, "'p'");
  expect_section_refused("(:action a :condition (p))", 12, "':condition'");
  expect_section_refused("(:durative-action a :effect ())", 1, "without :duration");
  expect_section_refused("(:durative-action a :duration (< ?duration 3))", 31, "not a duration constraint");
  expect_section_refused("(:durative-action a :duration (= 3 ?duration))", 31, "not a duration constraint");
  expect_section_refused("(:durative-action a :duration () :condition (p))", 45, "without a time");
  expect_section_refused("(:durative-action a :duration () :effect (p))", 42, "without a time");
  expect_section_refused("(:durative-action a :duration () :effect (increase (f) 2))", 42, "without a time");
  expect_section_refused("(:durative-action a :duration () :condition (preference x (p)))", 45,
                         "preferences");
}

TEST(ParseErrors, OfConditions) {
  expect_section_refused("(:action a :precondition (not (p) (p)))", 26, "'not' with 2 parts");
  expect_section_refused("(:action a :precondition (imply (p)))", 26, "'imply' with 1 part");
  expect_section_refused("(:action a :precondition (forall (p)))", 26, "'forall' with 1 part");
  expect_section_refused("(:action a :precondition (exists (x) (p)))", 35, "variable expected");
  expect_section_refused("(:action a :precondition (< (f)))", 26, "'<' with 1 part");
  expect_section_refused("(:action a :precondition (< (f) ?x))", 33, "found the variable ?x");
  expect_section_refused("(:action a :precondition (< (+ 1) 2))", 29, "two operands");
  expect_section_refused("(:action a :precondition (< (/ 1 2 3) 2))", 29, "takes two operands");
  expect_section_refused("(:action a :precondition (q (g hammer)))", 29, "object fluents");
  expect_section_refused("(:action a :precondition (always (p)))", 26, "trajectory constraint 'always'");
  expect_section_refused("(:action a :precondition (preference n (p)))", 26, "preferences");
  expect_section_refused("(:action a :precondition (at start (p)))", 26, "'at …'");
  expect_section_refused("(:action a :precondition ((p)))", 27, "found a list");
  expect_section_refused("(:action a :precondition (:p))", 27, "keyword");
}

TEST(ParseErrors, OfEffects) {
  expect_section_refused("(:action a :effect (or (p)))", 20, "'or' in an effect");
  expect_section_refused("(:action a :effect (not (p) (p)))", 20, "one atom");
  expect_section_refused("(:action a :effect (not (not (p))))", 30, "object fluents");
  expect_section_refused("(:action a :effect (when (p)))", 20, "'when' effect with 1 part");
  expect_section_refused("(:action a :effect (forall (p)))", 20, "'forall' effect with 1 part");
  expect_section_refused("(:action a :effect (increase (f)))", 20, "a function and a value");
  expect_section_refused("(:action a :effect (increase ?x 1))", 30, "?x");
}

TEST(ParseErrors, OfProblems) {
  const std::vector<Refused> cases = {
      {"(define (problem x) (:init) (:goal ()))", {1, 1}, "no :domain"},
      {"(define (problem x) (:domain d) (:goal ()))", {1, 1}, "no :init"},
      {"(define (problem x) (:domain d) (:init))", {1, 1}, "no :goal", true},
      {"(define (problem x) (:domain d) (:domain d))", {1, 33}, "second :domain"},
      {"(define (problem x) (:domain d) (:init)\n(:length (:serial 3)))", {2, 1}, "unknown section", true},
      {"(define (problem x) (:constraints (p)))", {1, 21}, "trajectory constraints"},
      {"(define (problem x) (:goal))", {1, 21}, "one condition"},
      {"(define (problem x) (:init (= (f) g)))", {1, 35}, "a number expected"},
      {"(define (problem x) (:init (= (f) nan)))", {1, 35}, "a number expected"},
      {"(define (problem x) (:init (= (f) 1e999)))", {1, 35}, "a number expected"},
      {"(define (problem x) (:init (= (f))))", {1, 28}, "needs a function and a number"},
      {"(define (problem x) (:init (at -1 (p))))", {1, 32}, "before 0"},
      {"(define (problem x) (:init p))", {1, 28}, "'p'"},
      {"(define (problem x) (:init (not)))", {1, 28}, "one fact"},
      {"(define (problem x) (:metric least (f)))", {1, 21}, "not a metric"},
      {"(define (problem x) (:metric minimize (is-violated a)))", {1, 39}, "preferences"},
      {"(define (problem x) (:metric minimize 1) (:metric minimize 1))", {1, 42}, "second :metric"},
  };
  for (const Refused& c : cases) expect_refused(c, Kind::problem);
}

}  // namespace
}  // namespace roci::pddl
