// What is said of the values that owners of external functions gave, or gave none, and what of them a plan records.
#pragma once

#include <span>
#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

/// Whether the owner gave a value, or says that there is none or that it found none.
bool is_usable(const FunctionValue& answer);

/// Why nothing can be planned with this answer: "external function (f a b) of module m: late, REASON; asked OWNER,
/// model 3, at 12.5 s". Empty where it is usable.
std::string fault_of(const FunctionUse& use);
/// What to do about it; empty where there is no fault.
std::string remedy_of(const FunctionUse& use);

/// That no plan exists is not proved where owners found no value with the effort that they spent: "not known: OWNER
/// found no way for (f a b) and 2 more with the effort spent; ask again or give it more".
/// Empty where they found or disproved all.
std::string doubt_of(std::span<const FunctionUse> uses);

/// What owners proved: "OWNER says that there is no (f a b), REASON, and 2 more". Empty where they proved nothing.
std::string denial_of(std::span<const FunctionUse> uses);

/// The value as a plan that stands on it records it. The owner gave one.
temporal::FunctionValueUse recorded(const FunctionUse& use);

}  // namespace roci::planner::engine
