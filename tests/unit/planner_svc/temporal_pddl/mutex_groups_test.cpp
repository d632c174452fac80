#include "planner_svc/temporal_pddl/grounding/invariants/mutex_groups.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "planner_svc/temporal_pddl/grounding/encoding/variable_cover.hpp"
#include "planner_svc/temporal_pddl/grounding/instantiation/instantiate.hpp"
#include "planner_svc/temporal_pddl/grounding/lifted/lowering.hpp"
#include "planner_svc/temporal_pddl/grounding/simplification/relaxed_pruning.hpp"
#include "tests/unit/planner_svc/temporal_pddl/fixture.hpp"
#include "tests/unit/planner_svc/temporal_pddl/random_task.hpp"

namespace roci::planner::temporal_pddl {
namespace {

using grounding::encoding::cover;
using grounding::instantiation::instantiate;
using grounding::invariants::find_mutex_groups;
using grounding::lifted::lower_actions;
using grounding::reachability::explore;
using grounding::simplification::prune;
using call::Budget, call::Monitor, call::SearchLimits;
using grounding::instantiation::Conjunction, grounding::instantiation::GroundAction,
    grounding::instantiation::GroundEffects, grounding::instantiation::GroundLiteral,
    grounding::instantiation::GroundModel;
using grounding::invariants::MutexGroup;
using grounding::lifted::ConstantFunctions, grounding::lifted::StaticModel, grounding::lifted::Symbols;
using task::Task;

struct Ground {
  GroundModel model;
  std::vector<MutexGroup> groups;
};

Ground groups_of(const testing::Model& made) {
  const Symbols symbols(made.domain, made.problem);
  const auto actions = lower_actions(made.domain, symbols);
  const ConstantFunctions constants(made.problem, actions, symbols);
  const StaticModel static_model(made.problem, actions, symbols, constants);
  const Budget budget;
  const Monitor monitor;
  SearchLimits limits(budget, monitor);
  Ground result;
  result.model = instantiate(made.domain, made.problem, actions, static_model,
                             explore(actions, static_model, limits), limits);
  const auto reached = prune(result.model, limits);
  result.groups = find_mutex_groups(result.model, reached, symbols.predicates(), actions.size(), limits);
  return result;
}

constexpr const char* kLogistics = R"(
  (:requirements :typing :durative-actions)
  (:types place thing - object truck package - thing)
  (:predicates (at ?t - thing ?p - place) (in ?k - package ?t - truck) (road ?a ?b - place))
  (:durative-action drive :parameters (?t - truck ?a ?b - place) :duration (= ?duration 5)
    :condition (and (at start (at ?t ?a)) (at start (road ?a ?b)))
    :effect (and (at start (not (at ?t ?a))) (at end (at ?t ?b))))
  (:durative-action load :parameters (?k - package ?t - truck ?p - place) :duration (= ?duration 1)
    :condition (and (at start (at ?k ?p)) (over all (at ?t ?p)))
    :effect (and (at start (not (at ?k ?p))) (at end (in ?k ?t))))
  (:durative-action unload :parameters (?k - package ?t - truck ?p - place) :duration (= ?duration 1)
    :condition (and (at start (in ?k ?t)) (over all (at ?t ?p)))
    :effect (and (at start (not (in ?k ?t))) (at end (at ?k ?p)))))";

constexpr const char* kTwoTrucks = R"(
  (:objects t u - truck k - package a b c - place)
  (:init (at t a) (at u c) (at k b) (road a b) (road b c) (road c a)) (:goal (at k a)))";

TEST(MutexGroups, APlaceOrOnTheWay) {
  const Ground ground = groups_of(testing::model(kLogistics, kTwoTrucks));
  // a group for each truck (3 places, 3 drives), one for the package (3 places, 2 trucks, 6 loads, 6 unloads)
  std::multiset<std::pair<std::size_t, std::size_t>> sizes;
  for (const auto& group : ground.groups) sizes.emplace(group.atoms.size(), group.running.size());
  EXPECT_EQ(sizes.count({3, 3}), 2u);
  EXPECT_EQ(sizes.count({5, 12}), 1u);
  const Task task = testing::grounded(testing::model(kLogistics, kTwoTrucks)).task;
  EXPECT_EQ(task.layout.packed_bits(), 2u + 2u + 3u);
}

TEST(MutexGroups, TwoThingsAtOnceAreNoGroup) {
  const auto twice = testing::model(kLogistics, R"((:objects t - truck k - package a b - place)
    (:init (at t a) (at t b) (at k b) (road a b) (road b a)) (:goal (at k a)))");
  for (const auto& group : groups_of(twice).groups) {
    std::size_t initially = 0;
    for (const auto atom : groups_of(twice).model.initial_atoms) {
      initially += static_cast<std::size_t>(std::ranges::count(group.atoms, atom));
    }
    EXPECT_LE(initially, 1u);
  }
}

// Walks at random through what snap actions can do, with sets of atoms for states.
class Walk {
 public:
  Walk(const GroundModel& model, std::mt19937_64& random) : model_(model), random_(random) {
    state_.insert(model.initial_atoms.begin(), model.initial_atoms.end());
  }

  void step() {
    if (model_.actions.empty()) return;
    if (timed_ < model_.timed.size() && random_() % 10 == 0) return change(model_.timed[timed_++].effects);
    const std::size_t i = random_() % model_.actions.size();
    const GroundAction& action = model_.actions[i];
    const bool ends = running_.contains(i);
    if (!holds(ends ? action.at_end : action.at_start)) return;
    const auto before = state_;
    const auto before_running = running_;
    change(ends ? action.end_effects : action.start_effects);
    if (ends) {
      running_.erase(i);
    } else if (action.durative) {
      running_.insert(i);
    }
    const bool invariants =
        std::ranges::all_of(running_, [&](std::size_t r) { return holds(model_.actions[r].over_all); });
    if (invariants) return;
    state_ = before;
    running_ = before_running;
  }

  std::size_t members(const MutexGroup& group) const {
    std::size_t count = 0;
    for (const auto atom : group.atoms) count += state_.contains(atom);
    for (const auto action : group.running) count += running_.contains(action);
    return count;
  }

 private:
  bool holds(const Conjunction& conjunction) const {  // numbers left out: more can happen
    return std::ranges::all_of(conjunction.literals,
                               [&](GroundLiteral l) { return state_.contains(l.atom) != l.negated; });
  }
  void change(const GroundEffects& effects) {
    for (const auto atom : effects.deletes) state_.erase(atom);
    for (const auto atom : effects.adds) state_.insert(atom);
  }

  const GroundModel& model_;
  std::mt19937_64& random_;
  std::set<std::uint32_t> state_;
  std::set<std::size_t> running_;
  std::size_t timed_ = 0;
};

TEST(MutexGroups, HoldOnRandomWalks) {
  std::mt19937_64 random(7);
  std::size_t checked = 0;
  for (int round = 0; round < 300; ++round) {
    const auto made = round % 10 == 0 ? testing::model(kLogistics, kTwoTrucks) : testing::random_task(random);
    const Ground ground = groups_of(made);
    Walk walk(ground.model, random);
    for (int i = 0; i < 200; ++i) {
      walk.step();
      for (const auto& group : ground.groups) ASSERT_LE(walk.members(group), 1u);
    }
    checked += ground.groups.size();
  }
  EXPECT_GT(checked, 60u);
}

TEST(VariableCover, EachMemberOnceWithinAGroup) {
  std::mt19937_64 random(8);
  for (int round = 0; round < 200; ++round) {
    std::vector<bool> needed;
    for (std::size_t n = 1 + random() % 30; n > 0; --n) needed.push_back(random() % 4 != 0);
    std::vector<std::vector<std::uint32_t>> groups(random() % 6);
    for (auto& group : groups) {
      for (std::uint32_t i = 0; i < needed.size(); ++i) {
        if (needed[i] && random() % 3 == 0) group.push_back(i);
      }
    }
    std::vector<std::size_t> times(needed.size(), 0);
    for (const auto& part : cover(needed, groups)) {
      for (const auto member : part) ++times[member];
      EXPECT_TRUE(part.size() == 1 || std::ranges::any_of(groups, [&](const auto& group) {
                    return std::ranges::includes(group, part);
                  }));
    }
    for (std::size_t i = 0; i < needed.size(); ++i) EXPECT_EQ(times[i], needed[i] ? 1u : 0u);
  }
}

}  // namespace
}  // namespace roci::planner::temporal_pddl
