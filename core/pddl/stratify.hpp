// Stratification finds the order in which derived predicates can be evaluated (PDDL 2.2 negates only what is
// settled before).
#pragma once

#include <map>
#include <string>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Evaluation may recurse once per layer.
inline constexpr int kMaxLayers = 16;

/// Holds the layers of a domain's derived predicates.
struct Strata {
  /// Maps a derived predicate to its layer, from 0. A body depends negatively on lower layers only,
  /// positively on lower ones or its own.
  std::map<std::string, int> layer;
  /// Names a predicate that depends on its own negation, or needs more than kMaxLayers; then the layers mean
  /// nothing. It is empty if there is none.
  std::string failed;
};

/// Finds the layers of the domain's derived predicates.
Strata stratify(const Domain& domain);

}  // namespace roci::pddl
