#include "core/pddl/plan_text.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/pddl/function_table.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {
namespace {

TEST(PlanText, ReadsSteps) {
  const auto plan = parse_plan(
      "; found in 3 s\n\n0.001: (Drive A b) [12.5] ; first\r\n 13.5 : ( beep )\n7:(x)[ 0.0000005 ]", "p");
  ASSERT_EQ(plan.size(), 3u);
  EXPECT_EQ(plan[0].start, Microseconds(1000));
  EXPECT_EQ(print(plan[0].action), "(drive a b)");
  EXPECT_EQ(plan[0].duration, Microseconds(12500000));
  EXPECT_EQ(plan[0].where, (SourceLocation{3, 1}));
  EXPECT_EQ(plan[0].action.arguments[1].where, (SourceLocation{3, 17}));
  EXPECT_EQ(plan[1].start, Microseconds(13500000));
  EXPECT_FALSE(plan[1].duration);
  EXPECT_EQ(plan[2].duration, Microseconds(1)) << "rounded";
  EXPECT_TRUE(parse_plan("", "p").empty());
}

struct Refused {
  std::string text;
  SourceLocation where;
};

TEST(PlanText, RefusesOtherThings) {
  const std::vector<Refused> cases = {
      {"(a)", {1, 1}},
      {"\n1 (a)", {2, 3}},
      {"1:", {1, 3}},
      {"1: a", {1, 4}},
      {"1: (a", {1, 6}},
      {"1: ()", {1, 5}},
      {"1: (a ?x)", {1, 7}},
      {"1: (a (b))", {1, 7}},
      {"1: (a) [", {1, 9}},
      {"1: (a) [2", {1, 10}},
      {"1: (a) [x]", {1, 9}},
      {"1: (a) [2] x", {1, 12}},
      {"-1: (a)", {1, 1}},
      {"1: (a) [-2]", {1, 9}},
      {"nan: (a)", {1, 1}},
      {"2e9: (a)", {1, 1}},
      {"0: (a)\n0: (b) 1", {2, 8}},
  };
  for (const Refused& c : cases) {
    SCOPED_TRACE(c.text);
    try {
      parse_plan(c.text, "plan");
      ADD_FAILURE() << "accepted";
    } catch (const ParseError& error) {
      EXPECT_EQ(error.diagnostic().where, c.where) << error.what();
      EXPECT_EQ(error.file(), "plan");
    }
  }
}

TEST(PlanText, PrintsThreeDecimalsOrWhatIsNeeded) {
  EXPECT_EQ(print_seconds(Microseconds(0)), "0.000");
  EXPECT_EQ(print_seconds(Microseconds(1)), "0.000001");
  EXPECT_EQ(print_seconds(Microseconds(1500)), "0.0015");
  EXPECT_EQ(print_seconds(Microseconds(12500000)), "12.500");
  EXPECT_EQ(print_seconds(Microseconds(-2000)), "-0.002");
  EXPECT_EQ(print_plan({{Microseconds(1000), {"a", {{"b", {}}}, {}}, Microseconds(2000000), {}},
                        {{}, {"c", {}, {}}, {}, {}}}),
            "0.001: (a b) [2.000]\n0.000: (c)\n");
}

TEST(PlanText, RandomPlansComeBackEqual) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<std::int64_t> time(0, 999'999'999'999'999);
  for (int i = 0; i < 500; ++i) {
    const std::int64_t coarse = i % 2 == 0 ? 1 : 1000;
    PlanStep step;
    step.start = Microseconds(time(random) / coarse * coarse);
    step.action = {"act", {{"o" + std::to_string(i), {}}}, {}};
    if (i % 3 != 0) step.duration = Microseconds(time(random) / coarse * coarse);
    const auto back = parse_plan(print_plan({step}), "p");
    ASSERT_EQ(back.size(), 1u);
    EXPECT_EQ(back[0].start, step.start);
    EXPECT_EQ(back[0].duration, step.duration);
    EXPECT_EQ(back[0].action, step.action);
  }
}

TEST(FunctionTable, ReadsValues) {
  const FunctionTable table =
      parse_function_table("; t\n(Time a b) 12.5\n(time b a) unreachable ; c\n(k) -3\n(k) -3", "f");
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table.at("(time a b)"), 12.5);
  EXPECT_EQ(table.at("(time b a)"), std::nullopt);
  EXPECT_EQ(table.at("(k)"), -3);
}

TEST(FunctionTable, PrintedAndReadAgainItIsTheSame) {
  const FunctionTable table = {
      {"(k)", -3}, {"(time a b)", 0.1 + 0.2}, {"(time b a)", std::nullopt}, {"(z x)", 1e-30}};
  EXPECT_EQ(parse_function_table(print(table), "printed"), table);
}

TEST(FunctionTable, HasBoundsBesideExactValuesAndTellsWhatWasNotFound) {
  const std::string text =
      "(time a b) >= 10\n(time a b) 12.5\n(time b a) >=3 ; no blank\n(time b b) unknown\n(k) unreachable\n";
  const FunctionTables tables = parse_function_tables(text, "f");
  EXPECT_EQ(tables.exact, (FunctionTable{{"(time a b)", 12.5}, {"(k)", std::nullopt}}));
  EXPECT_EQ(tables.lower_bounds.at("(time a b)"), 10);
  EXPECT_EQ(tables.lower_bounds.at("(time b a)"), 3);
  EXPECT_TRUE(tables.unknown.contains("(time b b)"));
  EXPECT_EQ(parse_function_tables(print(tables), "printed"), tables);
  EXPECT_EQ(parse_function_table(text, "f"), tables.exact) << "a plan is judged by exact values alone";
}

TEST(FunctionTable, RefusesOtherThings) {
  const std::vector<Refused> cases = {
      {"(f a)", {1, 6}},        {"(f a) x", {1, 7}}, {"f 3", {1, 1}},     {"(f) 1 2", {1, 7}},
      {"(f) 1\n(f) 2", {2, 1}}, {"(f) nan", {1, 5}}, {"(f) inf", {1, 5}},
      {"(f) >= x", {1, 7}},     {"(f) >= 1\n(f) >= 2", {2, 1}}, {"(f) 1\n(f) unknown", {2, 1}},
  };
  for (const Refused& c : cases) {
    SCOPED_TRACE(c.text);
    try {
      parse_function_table(c.text, "table");
      ADD_FAILURE() << "accepted";
    } catch (const ParseError& error) {
      EXPECT_EQ(error.diagnostic().where, c.where) << error.what();
    }
  }
}

}  // namespace
}  // namespace roci::pddl
