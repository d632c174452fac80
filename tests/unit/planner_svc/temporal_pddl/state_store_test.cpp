#include "planner_svc/temporal_pddl/search/state_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace roci::planner::temporal_pddl {
namespace {

using search::NodeId;
using search::StateStore;
using search::Transition;
using task::SnapId;
using task::Word;

TEST(StateStore, GivesBackWhatItGot) {
  std::mt19937_64 random(5);
  StateStore store(3);
  std::vector<std::vector<Word>> states;
  std::vector<std::vector<std::uint8_t>> codes;
  std::vector<Transition> transitions;
  std::vector<NodeId> parents;
  for (std::size_t i = 0; i < 10000; ++i) {
    states.push_back({random(), random(), random()});
    codes.emplace_back(random() % 40);
    for (auto& byte : codes.back()) byte = static_cast<std::uint8_t>(random());
    transitions.push_back({SnapId(random() % 1000000), random() % 2 == 0});
    parents.push_back(i == 0 ? NodeId() : NodeId(random() % i));
    EXPECT_EQ(store.add(states[i], parents[i], transitions[i], codes[i]), NodeId(i));
  }
  double bytes = 0;
  for (std::size_t i = 0; i < store.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(store.state(NodeId(i)), states[i]));
    EXPECT_TRUE(std::ranges::equal(store.code(NodeId(i)), codes[i]));
    EXPECT_EQ(store.transition(NodeId(i)).snap, transitions[i].snap);
    EXPECT_EQ(store.transition(NodeId(i)).compressed, transitions[i].compressed);
    EXPECT_EQ(store.parent(NodeId(i)), parents[i]);
    bytes += static_cast<double>(codes[i].size());
  }
  EXPECT_NEAR(store.mean_bytes_per_state(), 24 + 16 + bytes / 10000, 1e-9);
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
