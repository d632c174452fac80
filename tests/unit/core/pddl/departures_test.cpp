// What departs from PDDL and has one reading is read so, with a warning at its place; strict reading refuses each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "core/pddl/check.hpp"
#include "core/pddl/printer.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kFerry =
    "(define (domain ferry) (:requirements :typing :numeric-fluents)\n"
    "(:types quay boat)\n"
    "(:predicates (moored ?b - boat ?q - quay))\n"
    "(:functions (load ?b - boat)))\n";

struct Departed {
  std::string text;
  Departure departure;
  SourceLocation where;
  std::string words;
};

template <typename Load>
void expect_warned(const Departed& c, Load load) {
  SCOPED_TRACE(c.text);
  try {
    const std::vector<Diagnostic> warnings = load(Strictness::tolerant);
    ASSERT_EQ(warnings.size(), 1U) << to_text(warnings);
    EXPECT_EQ(warnings[0].departure, c.departure) << to_text(warnings);
    EXPECT_EQ(warnings[0].where, c.where) << to_text(warnings);
    EXPECT_EQ(warnings[0].severity, Severity::warning);
    EXPECT_FALSE(warnings[0].remedy.empty());
    EXPECT_THAT(to_string(warnings[0]), HasSubstr(": warning: "));
    EXPECT_THAT(to_string(warnings[0]), HasSubstr(c.words));
    EXPECT_THAT(to_string(warnings[0]), HasSubstr(std::string("[") + to_string(c.departure) + "]"));
  } catch (const ParseError& error) {
    ADD_FAILURE() << error.what();
  }
  try {
    load(Strictness::strict);
    ADD_FAILURE() << "strict reading took it";
  } catch (const ParseError& error) {
    EXPECT_EQ(error.diagnostics().size(), 1U) << error.what();
    EXPECT_EQ(error.diagnostic().where, c.where) << error.what();
    EXPECT_EQ(error.diagnostic().departure, c.departure) << error.what();
    EXPECT_FALSE(error.unsupported());
  }
}

void expect_domain_warned(const Departed& c) {
  expect_warned(c, [&](Strictness strictness) { return load_domain(c.text, "d.pddl", strictness).warnings; });
}

void expect_problem_warned(const Departed& c) {
  const Domain domain = load_domain(kFerry, "d.pddl");
  expect_warned(
      c, [&](Strictness strictness) { return load_problem(c.text, "p.pddl", domain, strictness).warnings; });
}

TEST(Departures, OfCharacters) {
  const std::vector<Departed> cases = {
      {"\xef\xbb\xbf(define (domain d))", Departure::byte_order_mark, {1, 1}, "byte order mark"},
      {"(define\xc2\xa0(domain d))", Departure::odd_character, {1, 8}, "blank beyond ASCII"},
      {"(define (domain d) (:requirements :typing) (:types a \xe2\x80\x93 b))",
       Departure::odd_character,
       {1, 54},
       "read as '-'"},
      {"(define (domain d)\n(:predicates (p ?x, ?y)))", Departure::comma, {2, 19}, "read as a blank"},
      {"(define (domain d)\n(:predicates (p ?x?y)))", Departure::question_mark, {2, 19}, "missing before"},
      {"(define (domain d)\n(:predicates (p ? x)))", Departure::question_mark, {2, 17}, "behind '?'"},
      {"(define (domain d) (:requirements :typing)\n(:types a -b))", Departure::hyphen, {2, 11}, "behind"},
      {"(define (domain d) (:requirements :typing)\n(:types a- b))", Departure::hyphen, {2, 10}, "before"},
      {"(define (domain d) (:requirements :typing) (:types t)\n(:predicates (p ?x- t)))",
       Departure::hyphen,
       {2, 19},
       "before"}};
  for (const Departed& c : cases) expect_domain_warned(c);
}

TEST(Departures, OfFiles) {
  const std::vector<Departed> cases = {
      {"(define (domain d))\n)", Departure::outside_text, {2, 1}, "after the end of the definition"},
      {"(define (domain d))\nthe end", Departure::outside_text, {2, 1}, "after the end"},
      {"(define (domain d))\n(define (problem p) (:domain d))", Departure::outside_text, {2, 1}, "after"},
      {"(define (problem p) (:domain d))\n(define (domain d))", Departure::outside_text, {1, 1}, "before"},
      {"(define (domain d) (:requirements :preferences))",
       Departure::requirement_flag,
       {1, 35},
       "not supported"},
      {"(define (domain d) (:requirements :typign))",
       Departure::requirement_flag,
       {1, 35},
       "did you mean ':typing'"},
      {"(define (domain d) (:requirements typing))",
       Departure::requirement_flag,
       {1, 35},
       "read as ':typing'"},
      {"(define (domain d)\n(:durative-action a :duration (= ?duration 1)))",
       Departure::missing_requirement,
       {2, 1},
       ":durative-actions"},
      {"(define (domain d) (:requirements :strips)\n(:types t))",
       Departure::missing_requirement,
       {2, 9},
       ":typing"}};
  for (const Departed& c : cases) expect_domain_warned(c);
}

TEST(Departures, OfDeclarations) {
  const std::string head = "(define (domain d) (:requirements :typing :fluents)\n";
  const std::vector<Departed> cases = {
      {head + "(:types\n room hall - hall))", Departure::type_under_itself, {3, 7}, "'hall - object'"},
      {head + "(:types a - object\n a - b b - object))",
       Departure::type_twice,
       {3, 2},
       "'a' is declared twice"},
      {head + "(:types a\n a))", Departure::type_twice, {3, 2}, "'a' is declared twice"},
      {head + "(:types t)\n(:constants c c - t))", Departure::object_twice, {3, 15}, "constant 'c'"},
      {head + "(:predicates (p ?x))\n(:derived (p ?x)\n(p ?x)))",
       Departure::missing_requirement,
       {3, 11},
       ":derived"},
      {head + "(:predicates (p ?x)\n(p ?y)))", Departure::signature_twice, {3, 1}, "twice alike"},
      {head + "(:functions (f)\n(f)))", Departure::signature_twice, {3, 1}, "function 'f'"},
      {head + "(:functions (f) -\nreal))", Departure::number_type, {3, 1}, "read as 'number'"}};
  for (const Departed& c : cases) expect_domain_warned(c);
}

TEST(Departures, OfProblems) {
  const std::string head = "(define (problem p) (:domain ferry)\n";
  const std::vector<Departed> cases = {
      {head + "(:objects q - quay b - raft) (:init) (:goal ()))",
       Departure::undeclared_type,
       {2, 20},
       "'raft'"},
      {head + "(:objects b - boad) (:init) (:goal ()))",
       Departure::undeclared_type,
       {2, 11},
       "did you mean 'boat'"},
      {head + "(:objects q q - quay) (:init) (:goal ()))", Departure::object_twice, {2, 13}, "object 'q'"},
      {head + "(:init (= (total-cost) 0)) (:goal ()))",
       Departure::undeclared_function,
       {2, 11},
       "'total-cost' is not declared"},
      {head + "(:objects b - boat) (:init (= (load b) 3) (= (load b) 3)\n(= (load b) 4)) (:goal ()))",
       Departure::value_twice,
       {3, 4},
       "(load b) has another initial value since line 2"},
      {head + "(:init))", Departure::missing_goal, {1, 1}, "no :goal"},
      {head + "(:init) (:goal ())\n(:length (:serial 4)))", Departure::old_section, {3, 1}, "':length'"},
      {head + "(:init (at 3 (moored b q))) (:objects b - boat q - quay) (:goal ()))",
       Departure::missing_requirement,
       {2, 8},
       ":timed-initial-literals"},
      {"(define (problem p) (:domain fairy) (:init) (:goal ()))",
       Departure::domain_name,
       {1, 1},
       "read for 'ferry'"}};
  for (const Departed& c : cases) expect_problem_warned(c);
}

TEST(Departures, AreReadAsTheWarningSays) {
  const Domain plain = load_domain(kFerry, "d");
  std::string odd = "\xef\xbb\xbf" + kFerry;
  const auto change = [&odd](const std::string& from, const std::string& to) {
    odd.replace(odd.find(from), from.size(), to);
  };
  change("?b - boat ?q", "? b -boat,?q");
  change("(:functions", "(:predicates (moored ?x - boat ?y - quay))\n(:functions");
  change(":typing", "typing :preferences");
  change("\n(:types", "\r\n(:types");
  odd += "; the end\n)";
  EXPECT_EQ(load_domain(odd, "d"), plain);
  EXPECT_EQ(load_domain(odd, "d").warnings.size(), 8U) << to_text(load_domain(odd, "d").warnings);

  const Problem problem = load_problem(
      "(define (problem p) (:domain fairy) (:objects q - quay x - raft b - boat b - boat)\n"
      "(:init (= (lod b) 1) (= (load b) 2)))",
      "p", plain);
  EXPECT_EQ(problem.domain_name, "ferry");
  EXPECT_EQ(problem.objects[1].types, std::vector<std::string>{"object"});
  ASSERT_EQ(problem.values.size(), 1U);
  EXPECT_EQ(print(problem.values[0].fluent), "(load b)");
  EXPECT_EQ(print(problem.goal), "(and)");
}

TEST(Departures, OfTypesKeepWhatStandsBeforeThemInTheList) {
  const Domain d = load_domain("(define (domain d) (:requirements :typing) (:types room hall - hall))", "d");
  EXPECT_EQ(d.types[0].types, std::vector<std::string>{"hall"});
  EXPECT_EQ(d.types[1].types, std::vector<std::string>{"object"});
}

TEST(Departures, OfVariablesKeepInnerAndOuterApart) {
  const Domain d = load_domain(
      "(define (domain d) (:requirements :adl)\n(:predicates (p ?x) (q ?x))\n(:action a :parameters (?x)\n"
      " :precondition (and (p ?x) (forall (?x) (or (q ?x) (exists (?x) (p ?x)))) (q ?x))\n"
      " :effect (forall (?x ?y) (when (q ?y) (p ?x)))))",
      "d");
  EXPECT_EQ(print(d.actions[0].precondition),
            "(and (p ?x) (forall (?x' - object) (or (q ?x') (exists (?x'' - object) (p ?x'')))) (q ?x))");
  const auto& forall = std::get<ForallEffect>(d.actions[0].effects[0].node);
  EXPECT_EQ(forall.variables[0].name, "?x'");
  EXPECT_EQ(print(std::get<Literal>(std::get<When>(forall.effects[0].node).effects[0].node)), "(p ?x')");
  EXPECT_EQ(d.warnings.size(), 3U) << to_text(d.warnings);
  EXPECT_EQ(d.warnings[0].where, (SourceLocation{4, 37})) << to_text(d.warnings);
  EXPECT_EQ(load_domain(print(d), "d"), d);
}

TEST(Departures, ALineMayEndAsOnAnyMachine) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const std::string text =
        "; a comment" + end + "(define (domain d) ; more" + end + "(:predicates (p)) (:axion))" + end;
    try {
      load_domain(text, "d");
      ADD_FAILURE();
    } catch (const ParseError& error) {
      EXPECT_EQ(error.diagnostic().where, (SourceLocation{3, 19})) << error.what();
      EXPECT_EQ(error.diagnostics().size(), 1U) << error.what();
    }
  }
}

TEST(Departures, NothingIsSaidOfWhatIsRight) {
  EXPECT_THAT(load_domain(kFerry, "d").warnings, IsEmpty());
  EXPECT_THAT(load_domain("(DEFINE (DOMAIN D) (:Requirements :ADL :Durative-Actions :Fluents)\n"
                          "(:types a b - c c - object) (:predicates (p ?x - a))\n"
                          "(:durative-action A :parameters (?X - a ?y-z - b) :duration (= ?duration 1)\n"
                          " :condition (at start (not (P ?x))) :effect (at end (p ?x))))",
                          "d")
                  .warnings,
              IsEmpty());
  EXPECT_NO_THROW(load_domain(kFerry, "d", Strictness::strict));
}

// A thousand commas are one thing to say.
TEST(Departures, AlikeWarningsAreCounted) {
  std::string predicates;
  for (int i = 0; i < 1000; ++i) predicates += "(p" + std::to_string(i) + "),\n";
  const auto warnings = load_domain("(define (domain d) (:predicates " + predicates + "))", "d").warnings;
  ASSERT_EQ(warnings.size(), 5U);
  EXPECT_THAT(warnings.back().message, HasSubstr("and so in 995 more places"));
}

}  // namespace
}  // namespace roci::pddl
