// Internal to core/pddl: what the printers of fragments, actions and whole files share.
#pragma once

#include <string>
#include <vector>

#include "core/pddl/ast.hpp"

namespace roci::pddl {

/// "?x - rover ?y - (either site base)"
std::string print_typed_names(const std::vector<TypedName>& names);
/// "(f ?x - t)"
std::string print_signature(const Signature& signature);

/// Whole `(:action …)` and `(:durative-action …)` blocks, indented by two.
std::string print_action(const Action& action);
std::string print_action(const DurativeAction& action);

}  // namespace roci::pddl
