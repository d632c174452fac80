// This file translates between the kit's values and idl/command.idl.
#pragma once

#include <string>

#include "roci_idl/command.h"
#include "services/owner/command.hpp"

namespace roci::services::owner {

/// These translate one way and the other; the ledger judges the values.
Request from_wire(const v1::Command&);
v1::CommandAck to_wire(const Ack&, const std::string& owner);
v1::CommandResult to_wire(const Results&);
/// What an acknowledgement says; a number that is not finite counts as not measured.
CommandStatus status_from_wire(const v1::CommandAck&);

}  // namespace roci::services::owner
