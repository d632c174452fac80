/// What holds at the beginning of a PDDL problem: its facts and numbers, everything else is false (closed world), and
/// what the domain derives from them (PDDL 2.2, Edelkamp and Hoffmann 2004, section 2.2: the smallest fixpoint, layer
/// by layer). Quantifiers and the parameters of derived predicates range over all objects, so the work is bounded.
#pragma once

#include <cstddef>
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
  /// So many conditions and choices of objects are looked at, in all that is asked of one world together.
  static constexpr std::size_t kMostSteps = 500'000;

  /// Both outlive this. The domain's predicates are derived when a condition first asks for one of them.
  ClosedWorld(const pddl::Domain& domain, const pddl::Problem& problem);

  /// Whether a condition without free variables holds now. It is unknown where a number decides that has no value, and
  /// everything is unknown once kMostSteps are spent.
  temporal::Truth truth_of(const pddl::Condition& condition);

  /// Names the derived predicate, with its place, or the goal whose objects took all steps; empty: there were enough.
  const std::string& given_up_at() const { return given_up_at_; }

 private:
  using Binding = std::map<std::string, std::string>;  // variable → object

  void derive();
  bool fire(const pddl::DerivedPredicate& rule);
  temporal::Truth truth_of(const pddl::Condition& condition, const Binding& binding);
  temporal::Truth of_fact(const pddl::Atom& fact, const Binding& binding);
  temporal::Truth of_all(const std::vector<pddl::Condition>& parts, const Binding& binding);
  /// Judges the body under every choice of objects for the variables.
  temporal::Truth for_all(const std::vector<pddl::TypedName>& variables, const pddl::Condition& body,
                          const Binding& binding, bool negated);
  /// Counts steps; returns whether there were enough left.
  bool spend(std::size_t steps);

  const pddl::Domain& domain_;
  pddl::ObjectTable objects_;
  std::set<std::string> facts_;
  std::map<std::string, double> values_;
  bool derived_ = false;
  const pddl::DerivedPredicate* deriving_ = nullptr;  ///< the rule that is being applied
  std::size_t steps_ = 0;
  std::string given_up_at_;
};

}  // namespace roci::exec::problem
