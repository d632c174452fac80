// This file reads a goal of a goal kind in PDDL: a fact, or a condition of facts, numbers, `not`, `or` and derived
// predicates.
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"
#include "core/temporal/condition.hpp"

namespace roci::exec::mission {

/// Parses a text of `goal`, e.g. "(or (sent image-a) (>= (battery) 300000))". Throws pddl::ParseError for what is no
/// condition of PDDL; names and arities are not checked.
pddl::Condition read_goal_formula(const std::string& text);

/// Returns whether the formula is one fact that observations can establish by themselves; else it is judged on
/// everything that a problem written now would hold.
bool is_observed_fact(const pddl::Condition& formula, const pddl::Domain& domain);

/// Returns the formula over timelines, for engines: facts and fluents are timelines, "(sent image-a)",
/// "(battery)". Returns an empty condition where timelines cannot express it: under quantifiers, and for sums.
temporal::Condition over_timelines(const pddl::Condition& formula);

}  // namespace roci::exec::mission
