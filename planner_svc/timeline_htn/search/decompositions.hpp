// Decompositions say what a complex state can be made of, whatever the timelines: the and/or graph of
// behaviours below it, relaxed of conditions and times.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "planner_svc/timeline_htn/search/successors.hpp"

namespace roci::planner::timeline_htn::search {

/// Measures complex states when they are first asked for.
class Decompositions {
 public:
  Decompositions(Ground& ground, const Successors& successors) : ground_(&ground), successors_(&successors) {}

  /// Returns whether behaviours make a state up at all.
  bool derivable(StateId state);
  /// Returns whether all parts of a behaviour with these objects can be made up:
  /// else it leads nowhere, whatever the timelines.
  bool derivable(Index behaviour, const std::vector<Index>& objects);
  /// Returns whether behaviours make a complex state up without any of these states below it, which are sorted.
  bool derivable_without(StateId state, const std::vector<StateId>& excluded);
  /// Returns the fewest values that a state needs, itself counted and those to rest in not; kNone:
  /// no behaviours make it up.
  std::uint32_t values(StateId state);
  /// Returns states without which it cannot come about, itself among them, sorted: those that all its ways share.
  const std::vector<StateId>& landmarks(StateId state);

 private:
  struct Way {  // one behaviour with its objects
    std::vector<StateId> parts;
  };
  struct Entry {
    std::vector<Way> ways;
    std::uint32_t values = kNone;
    bool settled = false;  // whether the landmarks are known
    std::vector<StateId> landmarks;
  };

  // The parts that a plan reckons with; nothing: one of them does not exist.
  std::optional<Way> way_of(Index behaviour, const std::vector<Index>& objects);
  bool is_complex(StateId state) const { return ground_->at(state).kind == model::StateKind::complex; }
  Entry& entry(StateId state);
  std::vector<StateId> explore(StateId state);
  void measure(const std::vector<StateId>& states);
  void find_landmarks(StateId root);
  std::optional<std::vector<StateId>> shared_by_ways(StateId state);

  Ground* ground_;
  const Successors* successors_;
  std::unordered_map<StateId, Entry> entries_;
};

}  // namespace roci::planner::timeline_htn::search
