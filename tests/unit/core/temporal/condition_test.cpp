#include "core/temporal/condition.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "core/temporal/plan_bounds.hpp"

namespace roci::temporal {
namespace {

using Op = ConditionOp;

struct World {
  std::map<std::string, Value> values;
  Lookup lookup() const {
    return [this](const std::string& timeline) -> std::optional<Value> {
      const auto found = values.find(timeline);
      return found == values.end() ? std::nullopt : std::optional(found->second);
    };
  }
};

TEST(Condition, ComparesNumbersAtTheBoundary) {
  const World world{{{"battery", 500.0}}};
  const auto truth = [&](ConditionOp op, double operand) {
    return evaluate(compare("battery", op, operand), world.lookup());
  };
  EXPECT_EQ(truth(Op::lt, 500.0), Truth::no);
  EXPECT_EQ(truth(Op::lt, 500.5), Truth::yes);
  EXPECT_EQ(truth(Op::le, 500.0), Truth::yes);
  EXPECT_EQ(truth(Op::ge, 500.0), Truth::yes);
  EXPECT_EQ(truth(Op::ge, 500.5), Truth::no);
  EXPECT_EQ(truth(Op::gt, 500.0), Truth::no);
  EXPECT_EQ(truth(Op::eq, 500.0), Truth::yes);
  EXPECT_EQ(truth(Op::ne, 500.0), Truth::no);
}

TEST(Condition, StateWithoutArgumentsStandsForAnyArguments) {
  const World world{{{"nav", state("idle-at", {"wp-1"})}}};
  EXPECT_EQ(evaluate(compare("nav", Op::eq, state("idle-at")), world.lookup()), Truth::yes);
  EXPECT_EQ(evaluate(compare("nav", Op::eq, state("idle-at", {"wp-1"})), world.lookup()), Truth::yes);
  EXPECT_EQ(evaluate(compare("nav", Op::eq, state("idle-at", {"wp-2"})), world.lookup()), Truth::no);
  EXPECT_EQ(evaluate(compare("nav", Op::ne, state("going-to")), world.lookup()), Truth::yes);
}

TEST(Condition, UnobservedAndUnlikeKindsAreUnknown) {
  const World world{{{"nav", state("idle")}}};
  EXPECT_EQ(evaluate(compare("battery", Op::ge, 1.0), world.lookup()), Truth::unknown);
  EXPECT_EQ(evaluate(compare("nav", Op::ge, 1.0), world.lookup()), Truth::unknown);
  EXPECT_EQ(evaluate(compare("nav", Op::eq, true), world.lookup()), Truth::unknown);
}

TEST(Condition, EmptyAlwaysHolds) {
  EXPECT_EQ(evaluate({}, World{}.lookup()), Truth::yes);
  EXPECT_EQ(describe({}), "always");
  EXPECT_EQ(evaluate(all_of({}), World{}.lookup()), Truth::yes);
  EXPECT_EQ(evaluate(negate({}), World{}.lookup()), Truth::no);
}

TEST(Condition, SpeaksInPlainWords) {
  const Condition condition =
      all_of({compare("nav", Op::eq, state("idle-at", {"wp-1"})),
              any_of({compare("battery", Op::ge, 500.0), negate(compare("comm.window", Op::eq, true))})});
  EXPECT_EQ(describe(condition), "nav = idle-at(wp-1) and (battery >= 500 or not comm.window = true)");
  const World world{{{"nav", state("going-to", {"wp-1"})}, {"battery", 120.0}, {"comm.window", true}}};
  EXPECT_EQ(explain(condition, world.lookup()),
            "nav = idle-at(wp-1) (is going-to(wp-1)) and battery >= 500 (is 120) or not comm.window = true");
  EXPECT_EQ(explain(compare("battery", Op::ge, 500.0), World{}.lookup()), "battery >= 500 (never observed)");
  EXPECT_EQ(explain(compare("battery", Op::ge, 100.0), world.lookup()), "");
}

TEST(Condition, MalformedTreesAreNamedAndUnknown) {
  Condition short_tree{{{.op = Op::all_of, .child_count = 2}, {.op = Op::always}}};
  EXPECT_EQ(check(short_tree), "child counts do not add up to one tree");
  EXPECT_EQ(evaluate(short_tree, World{}.lookup()), Truth::unknown);
  Condition two_trees{{{.op = Op::always}, {.op = Op::always}}};
  EXPECT_NE(check(two_trees), "");
  EXPECT_EQ(evaluate(two_trees, World{}.lookup()), Truth::unknown);
  EXPECT_NE(check(Condition{{{.op = Op::all_of}}}), "");
  EXPECT_NE(
      check(Condition{{{.op = Op::negation, .child_count = 2}, {.op = Op::always}, {.op = Op::always}}}), "");
  EXPECT_NE(check(compare("", Op::eq, true)), "");
  EXPECT_NE(check(compare("nav", Op::lt, state("idle"))), "");
  EXPECT_NE(check(compare("nav", Op::eq, {})), "");
  EXPECT_EQ(check(any_of({compare("nav", Op::eq, state("idle")), negate(compare("b", Op::gt, 1.0))})), "");
}

TEST(Condition, DeepNestingCostsNoStack) {
  Condition deep = compare("a", Op::eq, true);
  deep.nodes.insert(deep.nodes.begin(), kMostConditionNodes - 2, {.op = Op::negation, .child_count = 1});
  EXPECT_EQ(check(deep), "");
  deep.nodes.insert(deep.nodes.begin(), 1'000'000, {.op = Op::negation, .child_count = 1});
  EXPECT_EQ(check(deep), "it has more than 10000 nodes");
  EXPECT_EQ(evaluate(deep, World{{{"a", true}}}.lookup()), Truth::yes);
}

TEST(Condition, NamesItsTimelinesOnce) {
  const Condition condition =
      all_of({compare("b", Op::eq, true), compare("a", Op::eq, true), compare("b", Op::ne, false)});
  EXPECT_EQ(timelines_of(condition), (std::vector<std::string>{"a", "b"}));
}

/// A random tree and, beside it, its truth by Kleene's tables computed while it is built.
struct Oracle {
  Condition condition;
  Truth truth;
};

Oracle grow(std::mt19937_64& random, int depth) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  if (depth == 0 || pick(4) == 0) {
    const std::string timeline = std::string(1, static_cast<char>('x' + pick(3)));
    const Truth truth = timeline == "x" ? Truth::yes : timeline == "y" ? Truth::no : Truth::unknown;
    return {compare(timeline, Op::eq, true), truth};
  }
  if (pick(3) == 0) {
    const Oracle part = grow(random, depth - 1);
    const Truth turned = part.truth == Truth::yes  ? Truth::no
                         : part.truth == Truth::no ? Truth::yes
                                                   : Truth::unknown;
    return {negate(part.condition), turned};
  }
  const bool conjunction = pick(2) == 0;
  std::vector<Condition> parts;
  Truth truth = conjunction ? Truth::yes : Truth::no;
  for (int i = 1 + pick(3); i > 0; --i) {
    const Oracle part = grow(random, depth - 1);
    parts.push_back(part.condition);
    truth = conjunction ? std::min(truth, part.truth) : std::max(truth, part.truth);
  }
  return {conjunction ? all_of(parts) : any_of(parts), truth};
}

TEST(ConditionProperty, RandomTreesFollowKleene) {
  std::mt19937_64 random(7);
  const World world{{{"x", true}, {"y", false}}};
  for (int i = 0; i < 5000; ++i) {
    const Oracle oracle = grow(random, 5);
    ASSERT_EQ(check(oracle.condition), "");
    ASSERT_EQ(evaluate(oracle.condition, world.lookup()), oracle.truth) << describe(oracle.condition);
    ASSERT_EQ(explain(oracle.condition, world.lookup()).empty(), oracle.truth == Truth::yes);
  }
}

TEST(ConditionProperty, RandomArraysNeverCrash) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 5000; ++i) {
    Condition condition;
    for (std::uint64_t n = random() % 8; n > 0; --n)
      condition.nodes.push_back({static_cast<ConditionOp>(random() % 10),
                                 static_cast<std::uint32_t>(random() % 4), random() % 4 ? "x" : "",
                                 random() % 2 ? Value{1.0} : Value{}});
    const std::string wrong = check(condition);
    const Truth truth = evaluate(condition, World{{{"x", 1.0}}}.lookup());
    if (wrong.find("add up") == std::string::npos) continue;
    EXPECT_EQ(truth, Truth::unknown);
  }
}

}  // namespace
}  // namespace roci::temporal
