// The printer turns a syntax tree into PDDL text. What parses back is equal to what was printed,
// parse_domain(print(d)) == d, if d could have come from a text at all: no `when` or `forall` without effects
// in durative actions.
#pragma once

#include <string>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// These print whole files.
std::string print(const Domain& domain);
std::string print(const Problem& problem);

/// These print fragments, for messages and reports, on one line.
std::string print(const Atom& atom);
std::string print(const Literal& literal);
std::string print(const Expression& expression);
std::string print(const Condition& condition);
std::string print(ComparisonOperator op);

/// Prints the shortest decimal without exponent that reads back as exactly this number.
std::string print_number(double value);

}  // namespace roci::pddl
