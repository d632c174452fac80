// A function table gives values of external functions as text, where no service gives them (`--functions
// FILE`). It has one tuple per line, and `;` begins a comment:
//   (traverse_time a b) 12.5
//   (traverse_time a c) unreachable
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace roci::pddl {

/// Maps the printed application, "(traverse_time a b)", to its value. An empty value says unreachable: no
/// action that needs it exists. What is not in the table is unknown.
using FunctionTable = std::map<std::string, std::optional<double>, std::less<>>;

/// Adds a tuple of a function, whose value is empty where it is unreachable.
void put(FunctionTable& table, const std::string& function, const std::vector<std::string>& arguments,
         std::optional<double> value);

/// Reads a table. Throws ParseError for another form, or a tuple that stands twice with different values.
FunctionTable parse_function_table(std::string_view text, std::string_view file);

/// Prints one tuple per line; parsed again, it is the same table to the last bit.
std::string print(const FunctionTable& table);

}  // namespace roci::pddl
