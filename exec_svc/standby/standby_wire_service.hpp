// Words and parcels in their wire form, and the clock that they count on.
#pragma once

#include <stdexcept>
#include <string>

#include "exec_svc/standby/lease.hpp"
#include "exec_svc/standby/parcel.hpp"
#include "roci_idl/standby.h"

namespace roci::exec::wire {

// The steady clock of this host.
Moment moment();

std::string name_of(Member member);  // "first", "second"
Member member_of(const std::string& name);

v1::LeaseMessage to_wire(const Word& word, const Arrival& arrival);
Word from_wire(const v1::LeaseMessage& member);
Arrival arrival_of(const v1::LeaseMessage& member);

v1::JournalChunk to_wire(const Parcel& parcel);
Parcel from_wire(const v1::JournalChunk& parcel);

}  // namespace roci::exec::wire
