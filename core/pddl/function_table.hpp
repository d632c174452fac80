// Values of external functions as text, where no service gives them (`--functions FILE`): one tuple per line,
// `;` for comments.
//   (traverse_time a b) 12.5
//   (traverse_time a c) unreachable
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace roci::pddl {

/// The printed application, "(traverse_time a b)", to its value; nullopt: unreachable, that is, no action
/// that needs the value exists. What is not in the table is unknown.
using FunctionTable = std::map<std::string, std::optional<double>, std::less<>>;

/// Throws ParseError: another form, or a tuple that stands twice with different values.
FunctionTable parse_function_table(std::string_view text, std::string_view file);

/// One tuple per line; parsed again, it is the same table to the last bit.
std::string print(const FunctionTable& table);

}  // namespace roci::pddl
