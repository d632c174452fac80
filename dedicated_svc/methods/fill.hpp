// This file fills templates of methods, and says what they name.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roci::dedicated::methods {

/// Returns the names that stand in braces, in their order. Nothing for braces that do not match or are empty.
std::optional<std::vector<std::string>> names_in(std::string_view text);

/// Puts in, for each name in braces, what `value_of` returns; nothing if it knows one of them not. The text is one of
/// which names_in() returns something.
std::optional<std::string> fill(
    std::string_view text, const std::function<std::optional<std::string>(const std::string&)>& value_of);

}  // namespace roci::dedicated::methods
