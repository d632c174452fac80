// Novelty by pairs: by hand, and against sets of all that has been seen.
#include "planner_svc/temporal_pddl/search/pair_novelty.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <utility>

namespace roci::planner::temporal_pddl {
namespace {

using search::PairNovelty;
using Facts = std::vector<std::uint32_t>;

TEST(PairNovelty, TellsNewFactsFromNewPairsFromNothingNew) {
  PairNovelty novelty(10);
  const auto see = [&](const Facts& facts, std::uint64_t kind) { return novelty.see(facts, facts, kind); };
  EXPECT_EQ(see({1, 2}, 0), 1);
  EXPECT_EQ(see({3, 4}, 0), 1);
  EXPECT_EQ(see({1, 4}, 0), 2);
  EXPECT_EQ(see({4, 1}, 0), PairNovelty::kNothingNew);
  EXPECT_EQ(see({1, 2}, 0), PairNovelty::kNothingNew);
  EXPECT_EQ(see({1, 2}, 1), 1);  // another kind
}

TEST(PairNovelty, LooksOnlyAtPairsWithWhatIsFresh) {
  PairNovelty novelty(10);
  EXPECT_EQ(novelty.see(Facts{1, 2, 3}, Facts{3}, 0), 1);
  EXPECT_EQ(novelty.see(Facts{1, 3}, Facts{1, 3}, 0), 1);  // 1 itself
  EXPECT_EQ(novelty.see(Facts{2, 3}, Facts{3}, 0), PairNovelty::kNothingNew);
  EXPECT_EQ(novelty.see(Facts{1, 2, 3}, Facts{}, 7), PairNovelty::kNothingNew);
}

// What has been seen never counts as new, and what is new hardly ever as seen.
TEST(PairNovelty, AgreesWithExactSetsBarringCollisions) {
  constexpr std::uint32_t kFacts = 60;
  PairNovelty novelty(kFacts);
  std::mt19937_64 random(5);
  std::set<std::pair<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>>> seen;
  Facts all(kFacts);
  std::iota(all.begin(), all.end(), 0u);
  int missed = 0, fresh_pairs = 0;
  for (int round = 0; round < 2000; ++round) {
    Facts state;
    std::ranges::sample(all, std::back_inserter(state), 6, random);
    const std::uint64_t kind = random() % 3;
    int expected = PairNovelty::kNothingNew;
    for (const std::uint32_t a : state) {
      for (const std::uint32_t b : state) {
        if (a <= b && seen.insert({kind, {a, b}}).second) expected = std::min(expected, a == b ? 1 : 2);
      }
    }
    const int told = novelty.see(state, state, kind);
    EXPECT_GE(told, expected) << round;
    fresh_pairs += expected == 2;
    missed += told > expected;
  }
  EXPECT_GT(fresh_pairs, 300);
  EXPECT_LT(missed, 60);
}

TEST(PairNovelty, KeepsWithinItsMemory) {
  EXPECT_EQ(PairNovelty(5).bytes(), std::size_t{8} << 10);
  EXPECT_EQ(PairNovelty(1'000'000).bytes(), std::size_t{8} << 20);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
