// This file reads conditions over timelines as mission files write them.
#pragma once

#include <map>
#include <string>

#include "core/mission/entry.hpp"
#include "core/temporal/condition.hpp"

namespace roci::exec::mission {

/// Reads `{timeline: T, is: V}` (or `is_not`, `below`, `at_most`, `at_least`, `above` with a number), `{all: […]}`,
/// `{any: […]}`, `{not: …}`; a list is a conjunction. V is true, false, a number, a state's name or
/// [name, argument, …]. Throws roci::mission::FileError with the place and the remedy.
temporal::Condition read_condition(const roci::mission::Entry& entry);

/// Replaces {name} by its value in timelines and operands; an operand that a number fills is that number.
temporal::Condition fill_names(const temporal::Condition& condition,
                               const std::map<std::string, std::string>& values);

}  // namespace roci::exec::mission
