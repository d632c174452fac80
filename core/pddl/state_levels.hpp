// External functions may depend on the state: such a value is asked for at declared levels of a fluent, and the
// level at which an action starts is one more parameter of the action. Planner and validator thus meet PDDL alone.
#pragma once

#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Returns what is wrong with the declared dependences: an unknown function or fluent, a fluent whose arguments are no
/// parameters of the function or have other types, levels that do not ascend, other levels of the same fluent in
/// another declaration, and a use outside of actions, or where an argument that the fluent needs is a quantified
/// variable. `domain` must be one in which check() finds nothing wrong.
std::vector<Diagnostic> check_state_dependence(const Domain& domain);

/// Returns the uses of such functions in the goal or the metric, which have no start to read the state at. `domain`
/// must come from load_domain().
std::vector<Diagnostic> check_state_dependence(const Problem& problem, const Domain& domain);

/// Makes of each dependence of a function f on the fluent (g …) with levels l₀ < l₁ < … a parameter of f, of the type
/// "g-level" with the constants g-l₀, g-l₁, … Each action that applies f gets the parameter ?g-level and, at its start,
/// the condition that g is at least its level and below the next one; so it cannot start below l₀. What each
/// parameter stands for is kept in Domain::level_parameters. `domain` must be one in which
/// check_state_dependence() finds nothing wrong; its dependences are gone afterwards.
void lower_state_dependence(Domain& domain);

}  // namespace roci::pddl
