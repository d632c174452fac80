// This file puts in words what owners of external functions gave, and says what of it a plan records.
#pragma once

#include <span>
#include <string>

#include "core/temporal/flexible_plan.hpp"
#include "planner_svc/engine/function_source.hpp"

namespace roci::planner::engine {

/// Returns whether the owner gave a value, or says that there is none or that it found none.
bool is_usable(const FunctionValue& answer);

/// Returns why nothing can be planned with this answer: "external function (f a b) of module m: late, REASON;
/// asked OWNER, model 3, at 12.5 s"; empty where it is usable.
std::string fault_of(const FunctionUse& use);
/// Returns what to do about it; empty where there is no fault.
std::string remedy_of(const FunctionUse& use);

/// Returns why it is not proved that no plan exists, where owners found no value with the effort that they spent:
/// "not known: OWNER found no way for (f a b) and 2 more with the effort spent; ask again or give it more"; empty
/// where they found or disproved all.
std::string doubt_of(std::span<const FunctionUse> uses);

/// Returns what owners proved: "OWNER says that there is no (f a b), REASON, and 2 more"; empty where they proved
/// nothing.
std::string denial_of(std::span<const FunctionUse> uses);

/// Returns the value, which the owner must have given, as a plan that rests on it records it.
temporal::FunctionValueUse recorded(const FunctionUse& use);

}  // namespace roci::planner::engine
