/// The round trips to owners behind links, as the journal keeps them: a run that is repeated has the same.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/temporal/duration.hpp"

namespace roci::exec::journal {

using RoundTrips = std::map<std::string, temporal::Duration>;

/// A line for each owner: its name, a blank, microseconds.
std::string round_trips_text(const RoundTrips&);
/// What is no such line is left out.
RoundTrips round_trips_of(std::string_view text);

}  // namespace roci::exec::journal
