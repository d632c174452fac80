// This file finds what a condition asks of single timelines.
#pragma once

#include <vector>

#include "core/temporal/condition.hpp"

namespace roci::exec::reactor {

/// Returns the comparisons that must all hold: the condition itself, or the parts of its conjunction. What
/// lies below an alternative or a negation is no demand by itself; the parts that follow it are left out as
/// well.
std::vector<temporal::ConditionNode> conjuncts(const temporal::Condition& condition);

}  // namespace roci::exec::reactor
