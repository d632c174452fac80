#include "core/pddl/printer.hpp"

#include <gtest/gtest.h>

#include "tests/unit/core/pddl/random_tree.hpp"
#include "tests/unit/core/pddl/texts.hpp"

namespace roci::pddl {
namespace {

TEST(Printer, DomainsComeBackEqual) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Domain domain = RandomTree(seed).domain();
    const std::string text = print(domain);
    ASSERT_TRUE(parse_domain(text, "printed") == domain) << "seed " << seed << "\n" << text;
  }
}

TEST(Printer, ProblemsComeBackEqual) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Problem problem = RandomTree(seed).problem();
    const std::string text = print(problem);
    ASSERT_TRUE(parse_problem(text, "printed") == problem) << "seed " << seed << "\n" << text;
  }
}

TEST(Printer, TreesOfDifferentSeedsDiffer) {  // or the two properties above would say nothing
  int equal = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    if (RandomTree(seed).domain() == RandomTree(seed + 1).domain()) ++equal;
  }
  EXPECT_LT(equal, 5);
}

TEST(Printer, WritesNumbersExactlyAndWithoutExponent) {
  EXPECT_EQ(print_number(0.1), "0.1");
  EXPECT_EQ(print_number(-3), "-3");
  EXPECT_EQ(print_number(1e21), "1000000000000000000000");
  EXPECT_EQ(print_number(1.0 / 3), "0.3333333333333333");
}

TEST(Printer, WritesFragmentsOnOneLine) {
  EXPECT_EQ(print(condition_of("(forall (?x - tool) (imply (q ?x)\n (or (p) (= ?x hammer))))")),
            "(forall (?x - tool) (imply (q ?x) (or (p) (= ?x hammer))))");
  EXPECT_EQ(print(condition_of("(<= (- (f)) (* 2 (g ?t)))")), "(<= (- (f)) (* 2 (g ?t)))");
  EXPECT_EQ(print(condition_of("(exists (?x - (either tool place)) (not (p)))")),
            "(exists (?x - (either tool place)) (not (p)))");
}

TEST(Printer, EqualityIgnoresWhereThingsStand) {
  EXPECT_EQ(condition_of("(and (p) (q ?t))"), condition_of("\n (and\n (p)\n   (q ?t))"));
  EXPECT_FALSE(condition_of("(and (p) (q ?t))") == condition_of("(and (q ?t) (p))"));
}

}  // namespace
}  // namespace roci::pddl
