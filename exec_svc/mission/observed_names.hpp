// This file replaces a PDDL plan's names of timelines by those under which the same timelines are observed.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::mission {

/// Returns the plan with observed timelines: where the mission says that a fluent or the fact of a window comes from a
/// timeline, impacts, conditions, tokens and rules name this timeline. A reader of both plan and observations then
/// sees one timeline, whose projection starts at the newest observation (R76). Other names stay.
temporal::FlexiblePlan with_observed_names(temporal::FlexiblePlan plan, const MissionModel& mission);

}  // namespace roci::exec::mission
