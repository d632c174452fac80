/// What mission.yaml says of objects and of the kinds of goals. Every reader throws roci::mission::FileError
/// with the place and the remedy.
#pragma once

#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/pddl/ast.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::mission {

/// The list `objects` of the file; none if it has no such list. `mission` knows its role and whether it has a domain,
/// without which types may be left out.
std::vector<ObjectModel> read_objects(const roci::mission::Entry& root, const MissionModel& mission);

/// The formula of an item of `goal`, in which something stands in the place of each {name}. Throws FileError at the
/// item for what is no condition of PDDL. `domain` may be null.
pddl::Condition read_goal(const roci::mission::Entry& goal, const roci::mission::Entry& kind,
                          const pddl::Domain* domain);

/// `mission` knows its role, its components and its families. With a domain a kind has a `goal` of conditions or an
/// `achieved` whose states stand for facts; without one it has `achieved` and no facts.
GoalKind read_goal_kind(const std::string& name, const roci::mission::Entry& entry,
                        const MissionModel& mission);

/// Throws for the first of the keys that stands there: it belongs to a PDDL domain.
void refuse_without_domain(const roci::mission::Entry& entry, std::initializer_list<const char*> keys);

/// The name of a timeline with {robot} replaced by the executive's robot. Throws if it has none.
std::string read_timeline(const roci::mission::Entry& entry, const ExecutiveRole& role);

}  // namespace roci::exec::mission
