/// Brings a PDDL plan's names for what changes to the names under which the same things are observed.
#pragma once

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::mission {

/// Returns the plan with timelines that are observed: wherever the mission says that a fluent or the fact of a
/// window comes from a timeline, impacts, conditions, tokens and rules name this timeline. Who hears both the plan and
/// the observations then sees one timeline, whose projection starts at the newest observation (R76). Names that no
/// observation stands behind stay.
temporal::FlexiblePlan with_observed_names(temporal::FlexiblePlan plan, const MissionModel& mission);

}  // namespace roci::exec::mission
