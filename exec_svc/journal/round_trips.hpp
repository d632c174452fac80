// The journal keeps the round trips to owners behind links, so that a run that is repeated has the same.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/temporal/duration.hpp"

namespace roci::exec::journal {

using RoundTrips = std::map<std::string, temporal::Duration>;

/// Writes a line for each owner: its name, a blank, microseconds.
std::string round_trips_text(const RoundTrips&);
/// Reads such lines, and ignores any other.
RoundTrips round_trips_of(std::string_view text);

}  // namespace roci::exec::journal
