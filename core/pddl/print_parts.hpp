// This file is internal to core/pddl: the printers of fragments, actions and whole files share it.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// Prints "?x - rover ?y - (either site base)".
std::string print_typed_names(const std::vector<TypedName>& names);
/// Prints "(f ?x - t)".
std::string print_signature(const Signature& signature);

/// These print whole `(:action …)` and `(:durative-action …)` blocks, indented by two.
std::string print_action(const Action& action);
std::string print_action(const DurativeAction& action);

}  // namespace roci::pddl
