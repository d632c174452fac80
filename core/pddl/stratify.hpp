// The order in which derived predicates can be evaluated (PDDL 2.2: negation only of what is settled before).
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

struct Strata {
  // Derived predicate to its layer, from 0. A body depends negatively on lower layers only, positively on
  // lower ones or its own.
  std::map<std::string, int> layer;
  // A predicate that depends on its own negation; empty if there is none. Then the layers mean nothing.
  std::string cyclic;
};

Strata stratify(const Domain& domain);

}  // namespace roci::pddl
