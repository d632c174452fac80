// This file examines DATA and DATA_FRAG: samples, and those of discovery in particular.
#pragma once

#include "services/vendors/guard/submessages.hpp"

namespace roci::services::vendors::guard {

/// Returns whether DATA or DATA_FRAG is of a writer that no protocol has built in.
bool is_of_user(const Submessage&);
/// Returns the payload of DATA, or of the first fragment in DATA_FRAG, behind the encapsulation and in its own byte
/// order; empty: there is none.
ByteView payload_of(const Submessage&);
DatagramAdmission examine_data(const Submessage&, const GuidPrefix& sender);
DatagramAdmission examine_data_fragment(const Submessage&, const GuidPrefix& sender);

}  // namespace roci::services::vendors::guard
