// This file translates between core/temporal's values and plans and their wire form (idl/plan.idl), for every
// service.
#pragma once

#include <cstdint>
#include <stdexcept>

#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/plan_delta.hpp"
#include "roci_idl/basic.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"

namespace roci::services::wire {

/// Reports a sample that no conforming sender sends, e.g. with an enumerator out of range, or a plan or a condition
/// beyond the bounds of core/temporal/plan_bounds.hpp.
class WireError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns microseconds; -1 stands for no bound.
std::int64_t bound_to_wire(temporal::Duration bound);
v1::TimelineValue to_wire(const temporal::Value&);
v1::Condition to_wire(const temporal::Condition&);
v1::Plan to_wire(const temporal::FlexiblePlan&);
v1::PlanDelta to_wire(const temporal::PlanDelta&);
v1::Property to_wire(const temporal::Property&);

temporal::Value from_wire(const v1::TimelineValue&);
temporal::Condition from_wire(const v1::Condition&);
/// Throws WireError; the plan's inner consistency is temporal::check()'s business.
temporal::FlexiblePlan from_wire(const v1::Plan&);
temporal::PlanDelta from_wire(const v1::PlanDelta&);

}  // namespace roci::services::wire
