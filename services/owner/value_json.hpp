// This file writes and reads values of timelines in the files that owners keep.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "core/temporal/value.hpp"

namespace roci::services::owner {

/// Returns the value as JSON; null stands for a number that is not finite and for an unknown value.
nlohmann::json to_json(const temporal::Value& value);

/// Reads what to_json() has made; throws nlohmann::json::exception for an object that is no state.
temporal::Value value_in(const nlohmann::json& in);

}  // namespace roci::services::owner
