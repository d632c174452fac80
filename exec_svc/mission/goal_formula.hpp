/// A goal of a goal kind as PDDL reads it: a fact, or a condition of facts, numbers, `not`, `or` and what the domain
/// derives.
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"
#include "core/temporal/condition.hpp"

namespace roci::exec::mission {

/// The condition that a text of `goal` says, e.g. "(or (sent image-a) (>= (battery) 300000))". Throws pddl::ParseError
/// for what is no condition of PDDL; names and arities are not looked at.
pddl::Condition read_goal_formula(const std::string& text);

/// Whether it is one fact that observations may stand for by themselves; else it is judged on everything that a problem
/// of now would hold.
bool is_observed_fact(const pddl::Condition& formula, const pddl::Domain& domain);

/// The same over timelines, for engines: facts and fluents are timelines, "(sent image-a)", "(battery)". An empty
/// condition where that cannot be said: under quantifiers, and for sums.
temporal::Condition over_timelines(const pddl::Condition& formula);

}  // namespace roci::exec::mission
