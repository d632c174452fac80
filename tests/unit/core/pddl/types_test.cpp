#include "core/pddl/types.hpp"

#include <gtest/gtest.h>

#include "core/pddl/stratify.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

TEST(TypeTree, KnowsWhatIsAboveWhat) {
  const TypeTree types(parse_domain("(define (domain d) (:types a b - c c - d e - (either a x)))", "d"));
  EXPECT_TRUE(types.is_a("a", "a"));
  EXPECT_TRUE(types.is_a("a", "d"));
  EXPECT_TRUE(types.is_a("a", "object"));
  EXPECT_TRUE(types.is_a("e", "x"));
  EXPECT_TRUE(types.is_a("e", "d"));
  EXPECT_TRUE(types.knows("x")) << "named as a supertype only";
  EXPECT_FALSE(types.is_a("c", "a"));
  EXPECT_FALSE(types.is_a("a", "b"));
  EXPECT_FALSE(types.is_a("y", "object"));
  EXPECT_TRUE(types.accepts({"c"}, {"a", "b"}));
  EXPECT_FALSE(types.accepts({"a"}, {"a", "b"})) << "it might be a b";
  EXPECT_TRUE(types.accepts({"a", "b"}, {"b"}));
}

TEST(TypeTree, SurvivesCycles) {
  const TypeTree types(parse_domain("(define (domain d) (:types a - b b - a))", "d"));
  EXPECT_TRUE(types.is_a("a", "b"));
  EXPECT_TRUE(types.is_a("b", "a"));
}

TEST(ObjectTable, NumbersConstantsThenObjects) {
  const Domain domain = domain_with("");
  const ObjectTable objects(domain, problem_with(""));
  ASSERT_EQ(objects.size(), 4u);
  EXPECT_EQ(objects.find("hammer"), 0);
  EXPECT_EQ(objects.find("pit"), 3);
  EXPECT_EQ(objects.find("saw"), -1);
  EXPECT_EQ(objects.of_types({"thing"}), (std::vector<int>{0, 2}));
  EXPECT_EQ(objects.of_types({"tool"}), std::vector<int>{0});
  EXPECT_EQ(objects.of_types({"tool", "thing", "place"}), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_TRUE(objects.has_type(0, {"thing"}));
  EXPECT_FALSE(objects.has_type(0, {"place"}));
}

TEST(ObjectTable, GivesAnObjectTheTypesOfAllItsDeclarations) {  // as IPC temporal machine shop needs it
  const Domain domain = parse_domain("(define (domain d) (:types k8 k20 - kiln))", "d");
  const Problem problem =
      parse_problem("(define (problem x) (:domain d) (:objects k - k8 k - k20) (:init) (:goal ()))", "x");
  const ObjectTable objects(domain, problem);
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects.of_types({"k8"}), std::vector<int>{0});
  EXPECT_EQ(objects.of_types({"k20"}), std::vector<int>{0});
  EXPECT_EQ(objects.of_types({"kiln"}), std::vector<int>{0});
}

TEST(Stratify, PutsNegationAboveWhatItNegates) {
  const Strata strata =
      stratify(domain_with("(:predicates (a) (b) (c)) (:derived (a) (or (p) (a))) (:derived (b) (not (a))) "
                           "(:derived (c) (imply (b) (p)))"));
  EXPECT_EQ(strata.failed, "");
  EXPECT_EQ(strata.layer.at("a"), 0);
  EXPECT_EQ(strata.layer.at("b"), 1);
  EXPECT_EQ(strata.layer.at("c"), 2);
}

TEST(Stratify, RefusesCyclesThroughNegationAndTowersOfIt) {
  EXPECT_NE(stratify(domain_with("(:predicates (a) (b)) (:derived (a) (not (b))) (:derived (b) (a))")).failed,
            "");
  EXPECT_EQ(
      stratify(domain_with("(:predicates (a) (b)) (:derived (a) (not (not (b)))) (:derived (b) (a))")).failed,
      "");
  std::string tower = "(:derived (t0) (p))";
  for (int i = 1; i <= kMaxLayers; ++i) {
    tower += "(:derived (t" + std::to_string(i) + ") (not (t" + std::to_string(i - 1) + ")))";
  }
  EXPECT_NE(stratify(domain_with(tower)).failed, "");
}

}  // namespace
}  // namespace roci::pddl
