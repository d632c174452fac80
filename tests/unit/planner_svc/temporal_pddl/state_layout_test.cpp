#include "planner_svc/temporal_pddl/task/state_layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>

namespace roci::planner::temporal_pddl {
namespace {

using task::FactId, task::IdVector, task::NumberId, task::StateLayout, task::StateView, task::Word;

struct RandomLayout {
  std::vector<std::vector<FactId>> variables;
  IdVector<FactId, FactId> negation_of;
  std::size_t bits = 0;
};

RandomLayout random_layout(std::mt19937_64& random) {
  RandomLayout result;
  std::size_t facts = 0;
  for (std::size_t n = 1 + random() % 60; n > 0; --n) {
    std::vector<FactId> variable;
    for (std::size_t k = random() % 3 == 0 ? 1 + random() % 300 : 1; k > 0; --k)
      variable.emplace_back(facts++);
    result.bits += static_cast<std::size_t>(std::bit_width(variable.size()));
    result.variables.push_back(std::move(variable));
  }
  result.negation_of.assign(facts, FactId());
  for (std::size_t n = random() % 10; n > 0; --n) result.negation_of.push_back(FactId(random() % facts));
  std::ranges::shuffle(result.variables, random);
  return result;
}

// R9: ⌈log2(values)⌉ bits per variable, and what is written is read, against one flag per fact.
TEST(StateLayout, BehavesAsFlagsDo) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 100; ++round) {
    const RandomLayout made = random_layout(random);
    const std::size_t numbers = random() % 4;
    const StateLayout layout(made.variables, made.negation_of, numbers);
    EXPECT_EQ(layout.packed_bits(), made.bits);
    EXPECT_LE(layout.words(), made.bits / 32 + 1 + numbers);
    std::vector<Word> state(layout.words(), 0);
    std::vector<bool> flags(made.negation_of.size(), false);
    std::vector<double> values(numbers, 0);
    for (int change = 0; change < 200; ++change) {
      if (numbers > 0 && random() % 4 == 0) {
        const std::size_t i = random() % numbers;
        values[i] = static_cast<double>(random()) / 3 - 1e15;
        layout.set_number(state, NumberId(i), values[i]);
      }
      const auto& variable = made.variables[random() % made.variables.size()];
      const FactId fact = variable[random() % variable.size()];
      if (random() % 3 == 0) {
        layout.remove(state, fact);
        flags[fact.index()] = false;
      } else {
        layout.add(state, fact);
        for (const FactId other : variable) flags[other.index()] = other == fact;
      }
    }
    for (std::size_t i = 0; i < flags.size(); ++i) {
      const FactId original = made.negation_of[FactId(i)];
      EXPECT_EQ(layout.holds(state, FactId(i)), original.is_none() ? flags[i] : !flags[original.index()]);
    }
    for (std::size_t i = 0; i < numbers; ++i)
      EXPECT_EQ(layout.numbers(StateView(state))[NumberId(i)], values[i]);
  }
}

TEST(StateLayout, ChangingANegationDoesNothing) {
  IdVector<FactId, FactId> negation_of(1, FactId());
  const FactId negation = negation_of.push_back(FactId(0));
  const StateLayout layout({{FactId(0)}}, negation_of, 0);
  std::vector<Word> state(layout.words(), 0);
  layout.add(state, FactId(0));
  layout.add(state, negation);
  EXPECT_TRUE(layout.holds(state, FactId(0)));
  layout.remove(state, FactId(0));
  layout.remove(state, negation);
  EXPECT_TRUE(layout.holds(state, negation));
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
