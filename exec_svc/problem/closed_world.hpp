// The closed world is what holds at the beginning of a PDDL problem: its facts and numbers (everything else is
// false), and what the domain derives from them (PDDL 2.2, Edelkamp and Hoffmann 2004, section 2.2: the smallest
// fixpoint, layer by layer).
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/pddl/ast.hpp"
#include "core/pddl/types.hpp"
#include "core/temporal/condition.hpp"

namespace roci::exec::problem {

/// Judges conditions on the initial state of a PDDL problem, derived predicates included.
class ClosedWorld {
 public:
  /// Derives everything that the domain's rules derive. Both arguments must outlive this object.
  ClosedWorld(const pddl::Domain& domain, const pddl::Problem& problem);

  /// Returns whether a condition without free variables holds; unknown where it depends on a number without
  /// value.
  temporal::Truth truth_of(const pddl::Condition& condition) const;

 private:
  using Binding = std::map<std::string, std::string>;  // variable → object

  void derive();
  bool fire(const pddl::DerivedPredicate& rule);
  temporal::Truth truth_of(const pddl::Condition& condition, const Binding& binding) const;
  temporal::Truth of_all(const std::vector<pddl::Condition>& parts, const Binding& binding) const;
  /// Judges the body under every choice of objects for the variables from `next` on.
  temporal::Truth for_all(const std::vector<pddl::TypedName>& variables, std::size_t next,
                          const pddl::Condition& body, Binding& binding, bool negated) const;

  const pddl::Domain& domain_;
  pddl::ObjectTable objects_;
  std::set<std::string> facts_;
  std::map<std::string, double> values_;
};

}  // namespace roci::exec::problem
