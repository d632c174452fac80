// This file reads what mission.yaml says of objects and of the kinds of goals. Every reader throws
// roci::mission::FileError with the place and the remedy.
#pragma once

#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/pddl/ast.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::mission {

/// Reads the list `objects`, or returns no objects if the file has no such list. `mission` knows its role and whether
/// it has a domain, without which types may be left out.
std::vector<ObjectModel> read_objects(const roci::mission::Entry& root, const MissionModel& mission);

/// Reads the formula of an item of `goal`, with a placeholder for each {name}. Throws FileError at the item for
/// what is no condition of PDDL. `domain` may be null.
pddl::Condition read_goal(const roci::mission::Entry& goal, const roci::mission::Entry& kind,
                          const pddl::Domain* domain);

/// Reads one kind of goal; `mission` knows its role, its components and its families. With a domain a kind has a
/// `goal` of conditions or an `achieved` whose states stand for facts; without one it has `achieved` and no facts.
GoalKind read_goal_kind(const std::string& name, const roci::mission::Entry& entry,
                        const MissionModel& mission);

/// Throws for the first of these keys that the entry has, since they belong to a PDDL domain.
void refuse_without_domain(const roci::mission::Entry& entry, std::initializer_list<const char*> keys);

/// Reads the name of a timeline, with {robot} replaced by the executive's robot. Throws if the executive has
/// none.
std::string read_timeline(const roci::mission::Entry& entry, const ExecutiveRole& role);

}  // namespace roci::exec::mission
