// Pairs of facts from which the goals are out of reach, against all states of small tasks.
#include "planner_svc/temporal_pddl/dead_ends/backward_h2_mutexes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/call/planning_failure.hpp"
#include "planner_svc/temporal_pddl/search/goal_test.hpp"
#include "planner_svc/temporal_pddl/search/state_space.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_derived.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using call::Options, call::PlanningFailure, call::WindowExtraction;
using dead_ends::BackwardH2Mutexes, dead_ends::FdrOperators, dead_ends::ForwardH2Mutexes, dead_ends::Literal;
using search::GoalTest, search::NodeId, search::PlanPrefix, search::Rejection, search::StateSpace,
    search::Successor;
using task::ActionCompression, task::ActionId, task::SnapId, task::Task, task::Word;
using temporal::Duration;

bool go_on(std::size_t) { return true; }

// All states of a search, each by one plan, and from which of them it gets to the goals.
struct AllStates {
  struct Node {
    std::vector<Word> state;
    std::vector<ActionId> running;
    std::vector<std::size_t> parents = {};
    bool alive = false;
  };

  AllStates(const Task& task, ActionCompression steps, std::size_t most) {
    StateSpace space(task, Duration(1000), steps);
    GoalTest goal(task, space.check(), Duration(1000));
    std::vector<PlanPrefix> prefixes;
    std::map<std::tuple<std::vector<Word>, std::vector<ActionId>, std::uint32_t>, std::size_t> known;
    std::vector<std::size_t> goals;
    const auto reach = [&](Successor& successor, NodeId parent) {
      auto running = successor.prefix.running_actions;
      std::ranges::sort(running);
      const auto [place, is_new] =
          known.emplace(std::tuple(successor.state, running, successor.prefix.timed_done), nodes.size());
      if (is_new) {
        space.add(parent, successor);
        nodes.push_back({successor.state, running});
        if (goal.complete(successor.state, successor.prefix)) goals.push_back(place->second);
        prefixes.push_back(successor.prefix);
      }
      return place->second;
    };
    Successor successor;
    successor.state = task.initial_state;
    reach(successor, NodeId());
    for (std::size_t i = 0; i < nodes.size() && nodes.size() < most; ++i) {
      const auto applicable = space.applicable(prefixes[i]);
      for (const SnapId snap : std::vector(applicable.begin(), applicable.end())) {
        if (space.build(prefixes[i], snap, successor) != Rejection::none) continue;
        nodes[reach(successor, prefixes[i].node)].parents.push_back(i);
      }
    }
    while (!goals.empty()) {
      const std::size_t node = goals.back();
      goals.pop_back();
      if (std::exchange(nodes[node].alive, true)) continue;
      goals.insert(goals.end(), nodes[node].parents.begin(), nodes[node].parents.end());
    }
  }

  std::vector<Node> nodes;
};

// What is said of all states; how many of the dead ones are seen.
struct Seen {
  std::size_t alive = 0, dead = 0, seen = 0;

  void look(const Task& task, ActionCompression steps, const std::string& what) {
    const FdrOperators values(task, steps, [] {});
    auto pairs = BackwardH2Mutexes::find(task, values, go_on);
    ASSERT_TRUE(pairs);
    const auto reachable = ForwardH2Mutexes::find(task, values, go_on);
    ASSERT_TRUE(reachable);
    for (const auto& node : AllStates(task, steps, 500).nodes) {
      std::vector<Literal> literals;
      values.each_literal(node.state, node.running, [&](Literal literal) { literals.push_back(literal); });
      for (const Literal a : literals) {
        for (const Literal b : literals)
          ASSERT_TRUE(reachable->together(a, b)) << what << " " << a << " " << b;
      }
      const bool cut = pairs->in(node.state, node.running);
      ASSERT_FALSE(node.alive && cut) << what;
      alive += node.alive;
      dead += !node.alive;
      seen += cut;
    }
  }
};

// None: the goals are out of reach even if nothing is ever lost.
std::optional<Task> reachable_task(const testing::Model& model, const Options& options) {
  try {
    return testing::grounded(model, options).task;
  } catch (const PlanningFailure&) {
    return std::nullopt;
  }
}

TEST(BackwardH2Mutexes, AreInNoStateThatLeadsToTheGoals) {
  std::mt19937_64 random(3);
  Seen seen;
  for (int round = 0; round < 600; ++round) {
    const auto model = round % 2 == 0 ? testing::random_task(random) : testing::random_derived_task(random);
    Options options;
    options.compression_safety = round % 3 != 0;
    if (round % 5 == 0) options.windows = WindowExtraction::none;
    const auto task = reachable_task(model, options);
    if (!task) continue;
    seen.look(*task, ActionCompression::where_safe, "as needed, round " + std::to_string(round));
    seen.look(*task, ActionCompression::always, "whole, round " + std::to_string(round));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(seen.alive, 2000u);
  EXPECT_GT(seen.seen, 2000u);
}

// Carts on a map of one-way lanes, one at a place: they get in each other's way. towed: they may vanish too.
testing::Model carts(std::mt19937_64& random, int places, int number, bool towed) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::string objects, init, goal;
  for (int i = 0; i < places; ++i) {
    objects += " p" + std::to_string(i);
    for (int n = 0; n < 2; ++n)
      init += " (lane p" + std::to_string(i) + " p" + std::to_string(below(places)) + ")";
    if (i >= number) init += " (free p" + std::to_string(i) + ")";
  }
  objects += " - place";
  for (int i = 0; i < number; ++i) {
    objects += " c" + std::to_string(i);
    init += " (at c" + std::to_string(i) + " p" + std::to_string(i) + ")";
    goal += " (at c" + std::to_string(i) + " p" + std::to_string(below(places)) + ")";
  }
  return testing::model(R"((:requirements :typing :durative-actions) (:types cart place)
      (:predicates (at ?c - cart ?p - place) (free ?p - place) (lane ?a ?b - place))
      (:durative-action go :parameters (?c - cart ?a ?b - place) :duration (= ?duration 2)
        :condition (and (at start (at ?c ?a)) (at start (free ?b)) (over all (lane ?a ?b)))
        :effect (and (at start (not (at ?c ?a))) (at start (not (free ?b))) (at end (at ?c ?b))
          (at end (free ?a)))))" +
                            std::string(towed ? R"((:action tow :parameters (?c - cart ?p - place)
                              :precondition () :effect (not (at ?c ?p))))"
                                              : ""),
                        "(:objects" + objects + " - cart) (:init" + init + ") (:goal (and" + goal + "))");
}

TEST(BackwardH2Mutexes, SeeAllDeadEndsWhereTwoAreInEachOthersWay) {
  std::mt19937_64 random(4);
  Seen seen, seen_of_towed;
  int tasks = 0;
  for (int round = 0; round < 300; ++round) {
    const bool towed = round % 2 == 0;
    const auto made = carts(random, 5, 2, towed);
    const auto task = reachable_task(made, {});
    if (!task) continue;
    ++tasks;
    Seen& sum = towed ? seen_of_towed : seen;
    sum.look(*task, ActionCompression::always, "round " + std::to_string(round));
    sum.look(*task, ActionCompression::where_safe, "apart, round " + std::to_string(round));
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tasks, 100);
  EXPECT_GT(seen.alive, 1000u);
  EXPECT_GT(seen.dead, 1000u);
  EXPECT_EQ(seen.seen, seen.dead);
  EXPECT_GT(seen_of_towed.seen, seen_of_towed.dead / 2);  // a lost cart also takes its place
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
