// The vocabulary gives the lines of a model their meaning: names are looked up, and every object stands where
// its type may.
#pragma once

#include <limits>
#include <vector>

#include "planner_svc/timeline_htn/model/model.hpp"
#include "planner_svc/timeline_htn/reading/line.hpp"
#include "planner_svc/timeline_htn/reading/names.hpp"

namespace roci::planner::timeline_htn::reading {

/// Stands for a type that the model does not have, which is told where it is named: any object will do for it, so that
/// what is declared with it brings no second fault.
inline constexpr model::Index kUnknownType = std::numeric_limits<model::Index>::max();

/// Returns whether two types are the same, as far as they are known.
constexpr bool may_be_same(model::Index one, model::Index other) {
  return one == other || one == kUnknownType || other == kUnknownType;
}

/// Holds the variables that a line may use.
struct Scope {
  std::vector<model::Variable> variables;
  /// Says whether a name that is neither variable nor object becomes a variable.
  bool grows = false;
};

/// Knows all names of a model and the model as far as it was read.
struct Vocabulary {
  Names types{"type"};
  Names objects{"object"};
  Names relations{"relation"};
  Names numbers{"number"};
  Names components{"component"};
  std::vector<Names> states;  ///< by component
  Names behaviours{"behaviour"};
  model::Model model;

  /// Returns the type of that name, or kUnknownType, with the fault noted.
  model::Index type(const std::string& name, const mission::Entry& place) const;
  model::Term term(const std::string& name, model::Index type, Scope& scope,
                   const mission::Entry& place) const;
  /// Returns terms for a table or state with these types; `what` names it in messages.
  std::vector<model::Term> terms(const Application& application, const std::vector<model::Index>& types,
                                 Scope& scope, const mission::Entry& place) const;
  /// Takes "component.state(a, b)".
  model::Pattern pattern(Line& line, Scope& scope) const;
  /// Takes "state(a, b)" of one component.
  model::Pattern pattern_of(model::Index component, Line& line, Scope& scope) const;
  /// Takes a whole line that is a number: "2 * distance(a, b) + 5".
  model::Expression expression(Line& line, Scope& scope) const;
  /// Takes "edge(a, b)", "not edge(a, b)", "a != b", "distance(a, b) <= 4".
  model::Test test(Line& line, Scope& scope) const;
  /// Reads "1.5", or a number of the scope, in an entry of its own; "none" is an empty expression.
  model::Expression bound(const mission::Entry& entry, Scope& scope) const;
  /// Reads a list of tests, or one alone.
  std::vector<model::Test> tests(const mission::Entry& mapping, Scope& scope) const;
  std::vector<model::Variable> variables(const mission::Entry& mapping) const;

 private:
  model::Expression sum(Line& line, Scope& scope) const;
  void product(Line& line, Scope& scope, model::Expression& out) const;
  void factor(Line& line, Scope& scope, model::Expression& out) const;
};

/// Returns the items of a list, or the entry alone; fails where there are more than `most`.
std::vector<mission::Entry> one_or_more(const mission::Entry& entry, std::size_t most);
/// Returns the items of a list; fails where there are more than `most`.
std::vector<mission::Entry> items(const mission::Entry& list, std::size_t most);
/// Returns the fields of a mapping; fails where there are more than `most`.
std::vector<std::pair<std::string, mission::Entry>> fields(const mission::Entry& mapping, std::size_t most);

}  // namespace roci::planner::timeline_htn::reading
