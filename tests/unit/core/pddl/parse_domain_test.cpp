#include <gtest/gtest.h>

#include "core/pddl/printer.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

TEST(ParseDomain, ReadsDeclarations) {
  const Domain d = parse_domain(
      "(DEFINE (Domain D) ; comment\n (:requirements :Typing :modules)\n (:types a b - c d - (either c e) "
      "f)\n"
      " (:constants X y - a z)\n (:predicates (P ?u ?v - a ?w) (q))\n (:functions (f ?u - a) - number "
      "(g))\n)",
      "file.pddl");
  EXPECT_EQ(d.file, "file.pddl");
  EXPECT_EQ(d.name, "d");
  EXPECT_EQ(d.requirements[0].keyword, ":typing");
  const std::vector<TypedName> types = {
      {"a", {"c"}, {}}, {"b", {"c"}, {}}, {"d", {"c", "e"}, {}}, {"f", {"object"}, {}}};
  EXPECT_EQ(d.types, types);
  const std::vector<TypedName> constants = {{"x", {"a"}, {}}, {"y", {"a"}, {}}, {"z", {"object"}, {}}};
  EXPECT_EQ(d.constants, constants);
  const Signature p = {"p", {{"?u", {"a"}, {}}, {"?v", {"a"}, {}}, {"?w", {"object"}, {}}}, {}};
  EXPECT_EQ(d.predicates, (std::vector<Signature>{p, {"q", {}, {}}}));
  EXPECT_EQ(d.functions, (std::vector<Signature>{{"f", {{"?u", {"a"}, {}}}, {}}, {"g", {}, {}}}));
}

TEST(ParseDomain, EveryNodeKnowsItsPlace) {
  const Domain d = parse_domain(
      "(define (domain d)\n  (:predicates\n    (p ?x))\n(:action a\n :effect (not (p y))))", "d");
  EXPECT_EQ(d.predicates[0].where, (SourceLocation{3, 5}));
  EXPECT_EQ(d.predicates[0].parameters[0].where, (SourceLocation{3, 8}));
  EXPECT_EQ(d.actions[0].where, (SourceLocation{4, 1}));
  EXPECT_EQ(d.actions[0].effects[0].where, (SourceLocation{5, 10}));
  const auto& literal = std::get<Literal>(d.actions[0].effects[0].node);
  EXPECT_EQ(literal.atom.where, (SourceLocation{5, 15}));
  EXPECT_EQ(literal.atom.arguments[0].where, (SourceLocation{5, 18}));
}

TEST(ParseDomain, ReadsModulesOfThePaper) {  // Stellar, figure 2, word for word (R35)
  const Domain d = parse_domain(
      "(define (domain orbital) (:types slot)\n"
      "(:modules (:module ef_orbitalrarmplanner\n(:function (ra_move_dur ?from ?to - slot))\n"
      "(:function (ra_move_energy ?to - slot))\n))\n"
      "(:durative-action move :parameters (?a ?b - slot) :duration (= ?duration (ra_move_dur ?a ?b))\n"
      " :effect (at end (decrease (energy) (* 2 (ra_move_energy ?b))))))",
      "d");
  ASSERT_EQ(d.modules.size(), 1u);
  EXPECT_EQ(d.modules[0].name, "ef_orbitalrarmplanner");
  const Signature duration = {"ra_move_dur", {{"?from", {"slot"}, {}}, {"?to", {"slot"}, {}}}, {}};
  const Signature energy = {"ra_move_energy", {{"?to", {"slot"}, {}}}, {}};
  EXPECT_EQ(d.modules[0].functions, (std::vector<Signature>{duration, energy}));
  EXPECT_EQ(print(d.durative_actions[0].duration[0].bound), "(ra_move_dur ?a ?b)");
}

TEST(ParseDomain, ReadsConditions) {
  EXPECT_TRUE(std::get<And>(condition_of("()").node).parts.empty());
  EXPECT_TRUE(std::get<And>(condition_of("(and)").node).parts.empty());
  EXPECT_EQ(std::get<And>(condition_of("(and (p) (q ?t))").node).parts.size(), 2u);
  EXPECT_EQ(std::get<Or>(condition_of("(or (p) (q ?t) (p))").node).parts.size(), 3u);
  EXPECT_EQ(*std::get<Not>(condition_of("(not (p))").node).body, condition_of("(p)"));
  const auto imply = std::get<Imply>(condition_of("(imply (p) (q ?t))").node);
  EXPECT_EQ(*imply.premise, condition_of("(p)"));
  EXPECT_EQ(*imply.conclusion, condition_of("(q ?t)"));
  const auto forall = std::get<Forall>(condition_of("(forall (?x ?y - tool) (q ?x))").node);
  EXPECT_EQ(forall.variables, (std::vector<TypedName>{{"?x", {"tool"}, {}}, {"?y", {"tool"}, {}}}));
  EXPECT_EQ(*std::get<Exists>(condition_of("(exists (?x) (q ?x))").node).body, condition_of("(q ?x)"));
  const auto equality = std::get<TermEquality>(condition_of("(= ?t hammer)").node);
  EXPECT_EQ(equality.left.name, "?t");
  EXPECT_EQ(equality.right.name, "hammer");
}

TEST(ParseDomain, ReadsComparisons) {
  const std::vector<std::pair<std::string, ComparisonOperator>> operators = {
      {"<", ComparisonOperator::less},
      {"<=", ComparisonOperator::less_equal},
      {"=", ComparisonOperator::equal},
      {">=", ComparisonOperator::greater_equal},
      {">", ComparisonOperator::greater}};
  for (const auto& [word, op] : operators) {
    const auto comparison = std::get<Comparison>(condition_of("(" + word + " (f) (+ 1 (g ?t) 2))").node);
    EXPECT_EQ(comparison.op, op);
    EXPECT_EQ(print(comparison.left), "(f)");
    EXPECT_EQ(print(comparison.right), "(+ 1 (g ?t) 2)");
  }
  EXPECT_TRUE(std::holds_alternative<Comparison>(condition_of("(= 3 (f))").node));
}

TEST(ParseDomain, ReadsExpressions) {
  const auto right = [](const std::string& text) {
    return std::get<Comparison>(condition_of("(< 0 " + text + ")").node).right;
  };
  EXPECT_EQ(std::get<Number>(right("-2.5e1").node).value, -25.0);
  EXPECT_EQ(std::get<Number>(right(".5").node).value, 0.5);
  EXPECT_EQ(std::get<Number>(right("+7").node).value, 7.0);
  EXPECT_EQ(std::get<Arithmetic>(right("(- (f))").node).operands.size(), 1u);
  EXPECT_EQ(std::get<Arithmetic>(right("(- (f) 1)").node).op, ArithmeticOperator::subtract);
  EXPECT_EQ(std::get<Arithmetic>(right("(* 1 2 3)").node).operands.size(), 3u);
  EXPECT_EQ(std::get<Arithmetic>(right("(/ (f) 2)").node).op, ArithmeticOperator::divide);
  EXPECT_EQ(std::get<Atom>(right("f").node), (Atom{"f", {}, {}}))
      << "as IPC 2002 writes functions without parameters";
}

TEST(ParseDomain, ReadsEffects) {
  const auto effects =
      action_with(
          ":effect (and (p) (not (q ?t)) (forall (?x - tool) (when (q ?x) (and (s ?x) (p))))"
          " (assign (f) 1) (increase (f) 2) (decrease (g ?t) (f)) (scale-up (f) 3) (scale-down (f) 4))")
          .effects;
  ASSERT_EQ(effects.size(), 8u);
  EXPECT_FALSE(std::get<Literal>(effects[0].node).negated);
  EXPECT_TRUE(std::get<Literal>(effects[1].node).negated);
  const auto& when = std::get<When>(std::get<ForallEffect>(effects[2].node).effects[0].node);
  EXPECT_EQ(when.condition.at_start, condition_of("(q ?x)"));
  EXPECT_EQ(when.effects.size(), 2u);
  EXPECT_EQ(std::get<Assignment>(effects[3].node).op, AssignmentOperator::assign);
  EXPECT_EQ(std::get<Assignment>(effects[4].node).op, AssignmentOperator::increase);
  EXPECT_EQ(std::get<Assignment>(effects[5].node).op, AssignmentOperator::decrease);
  EXPECT_EQ(std::get<Assignment>(effects[6].node).op, AssignmentOperator::scale_up);
  EXPECT_EQ(std::get<Assignment>(effects[7].node).op, AssignmentOperator::scale_down);
}

TEST(ParseDomain, SortsDurativeConditionsByTime) {
  const auto condition =
      durative_with(
          ":duration (= ?duration 5) :condition (and (at start (p)) (over all (q ?t)) (at start (s ?t))"
          " (forall (?x - tool) (and (at end (q ?x)) (over all (s ?x)))))")
          .condition;
  EXPECT_EQ(condition.at_start, condition_of("(and (p) (s ?t))"));
  EXPECT_EQ(condition.over_all, condition_of("(and (q ?t) (forall (?x - tool) (s ?x)))"));
  EXPECT_EQ(condition.at_end, condition_of("(forall (?x - tool) (q ?x))"));
}

TEST(ParseDomain, KeepsThePredicateAtApartFromTimes) {
  const auto condition = durative_with(
      ":duration (= ?duration 5) :condition (at start (at ?t ?l)) :effect (at end (not (at ?t ?l)))");
  EXPECT_EQ(std::get<Atom>(condition.condition.at_start.node).symbol, "at");
  EXPECT_EQ(std::get<Literal>(condition.end_effects[0].node).atom.symbol, "at");
}

TEST(ParseDomain, SortsDurativeEffectsByTime) {
  const auto action = durative_with(
      ":duration () :effect (and (at start (not (p))) (at end (and (p) (increase (f) ?duration)))"
      " (when (and (at start (p)) (over all (s ?t))) (and (at start (q ?t)) (at end (s ?t))))"
      " (at end (when (q ?t) (p))) (increase (f) (* #t 2)))");
  ASSERT_EQ(action.start_effects.size(), 2u);
  ASSERT_EQ(action.end_effects.size(), 4u);
  const auto& mixed = std::get<When>(action.end_effects[2].node);
  EXPECT_EQ(mixed.condition.at_start, condition_of("(p)"));
  EXPECT_EQ(mixed.condition.over_all, condition_of("(s ?t)"));
  EXPECT_EQ(std::get<When>(action.end_effects[3].node).condition.at_end, condition_of("(q ?t)"));
  ASSERT_EQ(action.continuous_effects.size(), 1u);
  EXPECT_EQ(print(std::get<Assignment>(action.continuous_effects[0].node).value), "(* #t 2)");
}

TEST(ParseDomain, ReadsDurations) {
  EXPECT_TRUE(durative_with(":duration ()").duration.empty());
  const auto fixed = durative_with(":duration (= ?duration (/ (f) 2))").duration;
  ASSERT_EQ(fixed.size(), 1u);
  EXPECT_EQ(fixed[0].op, ComparisonOperator::equal);
  EXPECT_EQ(fixed[0].at, TimePoint::start);
  const auto range = durative_with(":duration (and (>= ?duration 1) (at end (<= ?duration (f))))").duration;
  ASSERT_EQ(range.size(), 2u);
  EXPECT_EQ(range[0].op, ComparisonOperator::greater_equal);
  EXPECT_EQ(range[1].op, ComparisonOperator::less_equal);
  EXPECT_EQ(range[1].at, TimePoint::end);
}

TEST(ParseDomain, ReadsDerivedPredicates) {
  const Domain d = domain_with("(:derived (s ?x - tool) (exists (?y - place) (r ?x ?y)))");
  ASSERT_EQ(d.derived.size(), 1u);
  EXPECT_EQ(d.derived[0].head, (Signature{"s", {{"?x", {"tool"}, {}}}, {}}));
  EXPECT_TRUE(std::holds_alternative<Exists>(d.derived[0].body.node));
}

TEST(ParseDomain, ToleratesGluedTypes) {  // as in IPC 2006 TPP
  EXPECT_EQ(domain_with("(:predicates (z ?g -thing))").predicates.back().parameters[0].types,
            std::vector<std::string>{"thing"});
}

}  // namespace
}  // namespace roci::pddl
