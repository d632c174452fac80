/// What holds at the beginning of a PDDL problem: its facts and numbers, everything else is false (closed world), and
/// what the domain derives from them (PDDL 2.2, Edelkamp and Hoffmann 2004, section 2.2: the smallest fixpoint, layer
/// by layer).
#pragma once

#include <map>
#include <set>
#include <string>

#include "core/pddl/ast.hpp"
#include "core/pddl/types.hpp"
#include "core/temporal/condition.hpp"

namespace roci::exec::problem {

class ClosedWorld {
 public:
  /// Derives all there is to derive. Both outlive this.
  ClosedWorld(const pddl::Domain& domain, const pddl::Problem& problem);

  /// Whether a condition without free variables holds now; unknown where a number decides that has no value.
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
