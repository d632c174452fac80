// This file writes constraints, impacts and amounts of a network in the words of its files
// (docs/network-format.md), so that they can be read again.
#pragma once

#include <string>
#include <string_view>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::model {

/// Prints the shortest decimal number that reads back as the same; "none" for an infinite one.
std::string to_text(double number);

/// Prints "12", "excavate_s", "-2 * arm_w + 5".
std::string to_text(const Amount& amount, const Network& network);

/// Prints "phase = sampling", "phase in a, b", "battery >= 5000", "heat in 100 .. 200"; the phase is not told.
std::string to_text(const temporal::timelines::Constraint& constraint, const Network& network);

std::string_view to_text(temporal::timelines::Kind kind);
std::string_view to_text(Tier tier);
std::string_view to_text(Measure measure);

}  // namespace roci::planner::utility_htn::model
