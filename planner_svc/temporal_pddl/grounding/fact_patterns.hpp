// Patterns of facts, and which of them are within reach: what reasons for an unreachable goal are made of.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/temporal_pddl/grounding/unreachable_goal.hpp"

namespace roci::planner::temporal_pddl::grounding {

/// Holds an atom, or its negation, some of whose objects do not matter (none).
struct Pattern {
  task::PredicateId predicate;
  std::vector<task::ObjectId> objects;
  bool negated = false;

  auto operator<=>(const Pattern&) const = default;

  /// Returns whether the objects are those of the pattern wherever it has some.
  bool fits(std::span<const task::ObjectId> given) const {
    for (std::size_t i = 0; i < objects.size(); ++i)
      if (!objects[i].is_none() && objects[i] != given[i]) return false;
    return true;
  }
  bool is_ground() const {
    return std::ranges::none_of(objects, [](task::ObjectId object) { return object.is_none(); });
  }
};

/// Answers what of an unreachable goal is within reach, and writes patterns as text. What it is given must outlive it.
class Patterns {
 public:
  explicit Patterns(const UnreachableGoal& known) : known_(known) {}

  Pattern of(instantiation::GroundLiteral literal) const;
  /// Returns whether something that fits holds at first, or is reached if nothing were ever deleted.
  bool within_reach(const Pattern& pattern) const;
  /// Returns whether a timed literal brings about something that fits.
  bool comes_with_time(const Pattern& pattern) const;
  /// Returns whether one of the atoms fits.
  bool any_fits(const std::vector<std::uint32_t>& atoms, const Pattern& pattern) const;

  /// Prints as "(at rover ?)".
  std::string text(const std::string& name, std::span<const task::ObjectId> objects) const;
  std::string text(const Pattern& pattern) const;

 private:
  const UnreachableGoal& known_;
};

/// Prints as "2.5 s".
std::string in_seconds(temporal::Duration duration);

}  // namespace roci::planner::temporal_pddl::grounding
