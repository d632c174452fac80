// A compact set of tuples against the calls that it was made of.
#include "planner_svc/temporal_pddl/values/tuple_set.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::planner::temporal_pddl::values {
namespace {

using engine::FunctionCall;

std::vector<std::string> drawn(std::mt19937& random, std::size_t arity, int objects) {
  std::uniform_int_distribution<int> one_of(0, objects - 1);
  std::vector<std::string> out;
  for (std::size_t i = 0; i < arity; ++i) out.push_back("o" + std::to_string(one_of(random)));
  return out;
}

TEST(TupleSet, FindsWhatASearchThroughTheCallsFinds) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const std::size_t arity = seed % 4;
    const int objects = 1 + static_cast<int>(seed % 13);
    std::vector<FunctionCall> calls;
    for (std::size_t i = 0; i < 1 + seed % 50; ++i)
      calls.push_back({"roads", "time", drawn(random, arity, objects), {}, {{"battery", 20, "battery-20"}}});
    const TupleSet tuples(calls);
    ASSERT_EQ(tuples.size(), calls.size());
    for (std::size_t i = 0; i < calls.size(); ++i) {
      EXPECT_EQ(tuples.call(i), calls[i]);
      EXPECT_TRUE(tuples.is_at(i, calls[i].arguments));
    }
    for (int i = 0; i < 50; ++i) {
      const std::vector<std::string> wanted = drawn(random, arity + (i % 10 == 9 ? 1 : 0), objects + 1);
      const auto first = std::ranges::find(calls, wanted, &FunctionCall::arguments);
      const auto found = tuples.find(wanted);
      ASSERT_EQ(found.has_value(), first != calls.end()) << seed;
      if (found) {
        EXPECT_EQ(*found, static_cast<std::size_t>(first - calls.begin()));
      }
      const std::size_t place = static_cast<std::size_t>(i) % calls.size();
      EXPECT_EQ(tuples.is_at(place, wanted), calls[place].arguments == wanted);
    }
  }
  EXPECT_TRUE(TupleSet().empty());
}

}  // namespace
}  // namespace roci::planner::temporal_pddl::values
