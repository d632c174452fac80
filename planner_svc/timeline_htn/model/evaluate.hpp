// This file evaluates expressions and static tests with objects in place of variables.
#pragma once

#include <compare>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::model {

/// Returns the number, or nothing where a table has none for these objects, something is divided by zero,
/// or the result is not finite.
std::optional<double> evaluate(const Model& model, const Expression& expression,
                               std::span<const Index> objects);

/// Returns the seconds as a duration, or nothing where they are above kLongestDuration, forwards or backwards.
std::optional<temporal::Duration> duration_of(double seconds);

/// Returns whether the test holds. A comparison with a number that there is not does not.
bool holds(const Model& model, const Test& test, std::span<const Index> objects);

/// Returns whether the relation has the row.
bool has_row(const Relation& relation, const std::vector<Index>& row);

/// Holds the bounds of how long a state lasts.
struct Bounds {
  temporal::Duration shortest{0};
  temporal::Duration longest = temporal::no_bound;
};
/// Returns them, or nothing where a bound has no number, is negative or too long, or the longest is below the shortest:
/// there is no such state then.
std::optional<Bounds> bounds(const Model& model, const State& state, std::span<const Index> objects);

/// Names a number that a service is asked for.
struct AskedNumber {
  Index table = 0;
  std::vector<Index> row;
  friend auto operator<=>(const AskedNumber&, const AskedNumber&) = default;
};
/// Adds those that an expression, a test or a state with its tests reads with these objects.
void add_asked(const Model& model, const Expression& expression, std::span<const Index> objects,
               std::set<AskedNumber>& out);
void add_asked(const Model& model, const Test& test, std::span<const Index> objects,
               std::set<AskedNumber>& out);
void add_asked(const Model& model, const State& state, std::span<const Index> objects,
               std::set<AskedNumber>& out);

/// Returns the object that a term stands for.
inline Index object_of(const Term& term, std::span<const Index> objects) {
  return term.object ? term.index : objects[term.index];
}

/// Returns what a command is given where these objects stand for the parameters of its state: "w1"; "w1.x" for a
/// property, in whose place the executive puts the value.
std::string text_of(const Model& model, const Argument& argument, std::span<const Index> objects);

}  // namespace roci::planner::timeline_htn::model
