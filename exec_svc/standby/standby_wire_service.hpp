// This file has lease messages and chunks in their wire form, and the clock that they count on.
#pragma once

#include <optional>
#include <string>

#include "exec_svc/goals/goal_set.hpp"
#include "exec_svc/standby/chunk.hpp"
#include "exec_svc/standby/lease.hpp"
#include "roci_idl/standby.h"

namespace roci::exec::standby {

/// Returns the time on the steady clock of this host.
Moment moment();

std::string name_of(Member member);  ///< "first", "second"
Member member_of(const std::string& name);

/// Translates a message; `executive` is the logical name of the pair.
v1::LeaseMessage to_wire(const LeaseMessage& message, const TransferProgress& arrival,
                         const std::string& executive);
LeaseMessage from_wire(const v1::LeaseMessage& member);
TransferProgress arrival_of(const v1::LeaseMessage& member);

/// These translate what members and owners say of the owners' leases; `commander` is the logical name of the pair.
v1::LeaseRequest to_wire(const OwnerRequest& request, const std::string& commander);
LeaseReport from_wire(const v1::LeaseState& state);

/// These translate a goal that is handed over; nothing for one that cannot be read.
v1::GoalHandOver to_wire(const goals::GoalRecord& goal, const std::string& executive, Member member);
std::optional<goals::GoalRecord> from_wire(const v1::GoalHandOver& hand_over);

/// These translate chunks; `executive` is the logical name of the pair.
v1::JournalChunk to_wire(const Chunk& chunk, const std::string& executive);
Chunk from_wire(const v1::JournalChunk& chunk);

}  // namespace roci::exec::standby
