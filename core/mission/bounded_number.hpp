// This file reads numbers of mission files that are valid only between two bounds.
#pragma once

#include <optional>
#include <string_view>

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Returns the number, or `fallback` where there is no entry. Throws FileError with the key's name where it lies
/// outside of [least, most].
double bounded_number(const std::optional<Entry>& entry, std::string_view key, double fallback, double least,
                      double most);

}  // namespace roci::mission
