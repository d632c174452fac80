#include "planner_svc/temporal_pddl/search/open_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <utility>

namespace roci::planner::temporal_pddl {
namespace {

using search::NodeId, search::OpenList, search::Priority, search::Ranks;
using task::SnapId;
using Snaps = std::vector<SnapId>;

constexpr Priority kAny{0, 0};

Snaps snaps(std::initializer_list<std::size_t> numbers) {
  Snaps result;
  for (const std::size_t number : numbers) result.emplace_back(number);
  return result;
}

void push_one(OpenList& open, Priority by_plan, Priority by_landmarks, bool preferred, std::size_t parent) {
  const Snaps only = snaps({7});
  open.push({by_plan, by_landmarks, kAny}, NodeId(parent), only, preferred ? only : Snaps{});
}

TEST(OpenList, EachSuccessorComesOnce) {
  for (const auto kinds : {OpenList::Kinds{}, OpenList::Kinds{true, false}, OpenList::Kinds{true, true}}) {
    OpenList open(kinds);
    for (std::size_t i = 0; i < 10; ++i)
      open.push({{1, 0}, kAny, kAny}, NodeId(i), snaps({1, 2, 3, 4, 5}), snaps({2, 5}));
    std::set<std::pair<NodeId, SnapId>> seen;
    while (const auto entry = open.pop()) EXPECT_TRUE(seen.emplace(entry->parent, entry->snap).second);
    EXPECT_EQ(seen.size(), 50u);
  }
}

TEST(OpenList, PreferredTakeTurnsAndGoFirstAfterProgress) {
  OpenList open({});
  for (std::size_t i = 0; i < 10; ++i) {
    push_one(open, {1, 0}, kAny, true, 100 + i);
    push_one(open, {1, 0}, kAny, false, i);
  }
  std::size_t preferred = 0;
  for (int i = 0; i < 10; ++i) preferred += open.pop()->parent.value >= 100;
  EXPECT_EQ(preferred, 5u);
  open.boost();
  for (int i = 0; i < 5; ++i) EXPECT_GE(open.pop()->parent.value, 100u);
  for (int i = 0; i < 5; ++i) EXPECT_LT(open.pop()->parent.value, 100u);
}

TEST(OpenList, TheBestByPlanAndTheBestByLandmarksTakeTurns) {
  OpenList open({.by_landmarks = true});
  for (std::size_t i = 0; i < 10; ++i) {
    const auto rank = static_cast<std::int64_t>(i);
    push_one(open, {rank, 0}, {10 - rank, 0}, false, i);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(open.pop()->parent, NodeId(i));
    EXPECT_EQ(open.pop()->parent, NodeId(9 - i));
  }
}

TEST(OpenList, StreaksOfYoungestAndOldestAmongThePreferred) {
  OpenList open({});
  for (std::size_t i = 0; i < 1000; ++i) push_one(open, {1, 4}, kAny, true, i);
  push_one(open, {1, 3}, kAny, true, 5000);
  EXPECT_EQ(open.pop()->parent, NodeId(std::size_t{5000}));
  std::size_t youngest = 0;
  std::size_t low = 0;
  std::size_t high = 999;
  for (int i = 0; i < 640; ++i) {
    const NodeId next = open.pop()->parent;
    ASSERT_TRUE(next == NodeId(low) || next == NodeId(high));
    youngest += next == NodeId(high);
    next == NodeId(high) ? --high : ++low;
  }
  EXPECT_NEAR(static_cast<double>(youngest), 320, 2);
}

TEST(OpenList, HoldsNothingOfWhatHasBeenTried) {
  OpenList open({.by_landmarks = true});
  const auto fill_and_empty = [&] {
    for (std::size_t parent = 0; parent < 100; ++parent) {
      const auto rank = static_cast<std::int64_t>(parent);
      open.push({{rank, 0}, {-rank, 0}, kAny}, NodeId(parent), snaps({1, 2, 3}), snaps({1}));
    }
    const std::size_t full = open.bytes();
    while (open.pop()) {
    }
    EXPECT_LE(open.bytes(), full - 100 * (3 * sizeof(SnapId) + 2 * sizeof(Priority)));
    return open.bytes();
  };
  const std::size_t once = fill_and_empty();
  EXPECT_EQ(fill_and_empty(), once);
}

// The same turns as with a queue of single entries for each kind, entries tried before left out.
TEST(OpenList, AgreesWithQueuesOfSingleEntries) {
  struct Queue {
    bool preferred;
    Priority Ranks::*rank;
    std::int64_t served = 0;
    std::map<Priority, std::deque<std::pair<NodeId, SnapId>>> ranks = {};
  };
  std::mt19937_64 random(1);
  OpenList open({true, true});
  std::vector<Queue> queues;
  for (const auto rank : {&Ranks::by_plan, &Ranks::by_landmarks, &Ranks::by_novelty}) {
    queues.push_back({true, rank});
    queues.push_back({false, rank});
  }
  std::set<std::pair<NodeId, SnapId>> tried;
  const auto expected = [&]() -> std::optional<std::pair<NodeId, SnapId>> {
    while (true) {
      Queue* next = nullptr;
      for (Queue& queue : queues) {
        if (!queue.ranks.empty() && (!next || queue.served < next->served)) next = &queue;
      }
      if (!next) return std::nullopt;
      ++next->served;
      auto& best = next->ranks.begin()->second;
      const bool oldest = !next->preferred || next->served / 64 % 2 == 0;
      const auto entry = oldest ? best.front() : best.back();
      oldest ? best.pop_front() : best.pop_back();
      if (best.empty()) next->ranks.erase(next->ranks.begin());
      if (tried.insert(entry).second) return entry;
    }
  };
  for (std::size_t parent = 0; parent < 300; ++parent) {
    Snaps successors, preferred;
    for (std::size_t snap = 0; snap < 12; ++snap) {
      if (random() % 2 == 0) successors.emplace_back(snap);
      if (random() % 4 == 0) preferred.emplace_back(snap);
    }
    std::ranges::shuffle(successors, random);
    const auto rank = [&] { return static_cast<std::int64_t>(random() % 4); };
    const Ranks ranks{{rank(), rank()}, {rank(), 0}, {-rank(), rank()}};
    open.push(ranks, NodeId(parent), successors, preferred);
    for (Queue& queue : queues) {
      for (const SnapId snap : successors) {
        if (queue.preferred && !std::ranges::binary_search(preferred, snap)) continue;
        queue.ranks[ranks.*queue.rank].emplace_back(NodeId(parent), snap);
      }
    }
    if (parent % 50 == 0) {
      open.boost();
      for (Queue& queue : queues) queue.served -= queue.preferred ? 1000 : 0;
    }
    for (std::uint64_t pops = random() % 8 + (parent == 299 ? 5000 : 0); pops > 0; --pops) {
      const auto want = expected();
      const auto got = open.pop();
      ASSERT_EQ(want.has_value(), got.has_value());
      if (!got) break;
      ASSERT_EQ(*want, std::pair(got->parent, got->snap));
    }
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
