// Ground states have objects in place of parameters; they are made when they are first met, with what may
// follow them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner_svc/timeline_htn/model/evaluate.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::search {

using model::Index;
using StateId = std::uint32_t;  ///< number of a ground state, over all components
inline constexpr Index kNone = ~Index{0};
/// Values by which a timeline goes on by itself, without a command, for a condition that looks at it.
inline constexpr std::size_t kStepsByItself = 3;

/// Holds a set of components: the bit of each by its number.
using ComponentSet = std::uint64_t;

/// Returns the state of a pattern whose variables stand for these objects.
model::GroundState ground_of(const model::Pattern& pattern, const std::vector<Index>& objects);

/// Describes what a timeline can hold.
struct Instance {
  model::GroundState state;
  model::Bounds bounds;
  model::StateKind kind = model::StateKind::simple;
  Index local = 0;  ///< number among the instances of its component
};

/// Knows the ground states that were met. It grows while a search goes on, so each search has one of its own.
class Ground {
 public:
  explicit Ground(const model::Model& model);

  const model::Model& model() const { return *model_; }
  /// Returns the state, or kNone where there is none with these objects.
  StateId find(const model::GroundState& state);
  const Instance& at(StateId state) const { return instances_[state]; }
  const model::State& definition(StateId state) const;
  /// Returns what may follow at once, without error states: in the order of the transitions, then of the objects.
  const std::vector<StateId>& next(StateId state);
  /// Returns whether one of them is this state, without making the others.
  bool may_follow(StateId from, StateId to) const;
  /// Returns how many transitions lead from one state to another of its component; kNone: none do.
  Index distance(StateId from, StateId to);
  /// Returns how many lead to a state to rest in.
  Index distance_to_rest(StateId from);
  /// Returns the states that fit and can be reached, the nearest first; bound variables have an object, others kNone.
  std::vector<StateId> reachable(StateId from, const model::Pattern& pattern, std::span<const Index> bound);
  /// Returns all states that can be reached, the nearest first.
  std::vector<StateId> reachable(StateId from);
  /// Returns whether a state is one of the pattern's, where variables that are kNone fit all.
  bool fits(StateId state, const model::Pattern& pattern, std::span<const Index> bound) const;
  /// Returns the components that bringing about some state of this one may touch or look at;
  /// what no plan changes is none of them.
  ComponentSet footprint(Index component) const { return footprints_[component]; }
  /// Returns the components whose timelines may move when some state of this one is brought about.
  ComponentSet moved_by(Index component) const { return moved_by_[component]; }
  /// Returns the components that conditions of behaviours look at, without those that are predicted.
  ComponentSet looked_at() const { return looked_at_; }
  /// Returns the components whose timelines are predicted.
  ComponentSet predicted() const { return predicted_; }
  bool is_predicted(Index component) const { return (predicted_ >> component & 1U) != 0; }
  /// Returns every way to give variables from `from` on an object of their type so that the tests hold.
  std::vector<std::vector<Index>> bindings(const std::vector<model::Variable>& variables,
                                           std::vector<Index> bound,
                                           const std::vector<model::Test>& where) const;
  std::size_t bytes() const { return bytes_; }
  std::string text(StateId state) const { return to_text(*model_, instances_[state].state); }

 private:
  struct Successors {
    bool known = false;
    std::vector<StateId> states;
  };
  const std::vector<Index>& distances(StateId from);
  void measure_footprints();

  const model::Model* model_;
  std::vector<std::vector<Index>> objects_of_;  // by type
  std::map<model::GroundState, StateId> numbers_;
  std::vector<Instance> instances_;
  std::vector<std::vector<StateId>> by_component_;
  std::vector<Successors> next_;
  std::unordered_map<StateId, std::vector<Index>> distances_;  // from a state, by local number
  std::vector<ComponentSet> moved_by_, footprints_;
  ComponentSet predicted_ = 0;
  ComponentSet looked_at_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace roci::planner::timeline_htn::search
