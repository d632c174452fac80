// This file makes the events by which a node itself informs operators.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "roci_idl/health.h"

namespace roci::services::node {

/// Makes an event with its properties, each a name and a value.
v1::Event make_event(v1::Severity severity, const std::string& code, const std::string& text,
                     const std::vector<std::pair<std::string, std::string>>& properties = {});

}  // namespace roci::services::node
