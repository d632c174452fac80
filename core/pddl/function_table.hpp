// A function table gives values of external functions as text, where no service gives them (`--functions
// FILE`). It has one tuple per line, and `;` begins a comment:
//   (traverse_time a b) 12.5
//   (traverse_time a b) >= 10
//   (traverse_time a c) unreachable
//   (traverse_time a d) unknown
// A tuple may have both an exact value and a lower bound. "unreachable" is proved;
// "unknown" says that no value was found.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace roci::pddl {

/// Maps the printed application, "(traverse_time a b)", to its value. An empty value says unreachable: no
/// action that needs it exists. Of what is not in the table nothing is known.
using FunctionTable = std::map<std::string, std::optional<double>, std::less<>>;

/// Adds a tuple of a function, whose value is empty where it is unreachable.
void put(FunctionTable& table, const std::string& function, const std::vector<std::string>& arguments,
         std::optional<double> value);

/// Holds what a file says: values of both accuracies, and where none was found.
struct FunctionTables {
  FunctionTable exact;
  std::map<std::string, double, std::less<>> lower_bounds;
  std::set<std::string, std::less<>> unknown;
  friend bool operator==(const FunctionTables&, const FunctionTables&) = default;
};

/// Reads a file. Throws ParseError for another form, or a tuple that stands twice with different values.
FunctionTables parse_function_tables(std::string_view text, std::string_view file);
/// Does the same and returns the exact values alone.
FunctionTable parse_function_table(std::string_view text, std::string_view file);

/// Prints one tuple per line; parsed again, it is the same table to the last bit.
std::string print(const FunctionTable& table);
/// Prints exact values, then lower bounds, then what is unknown.
std::string print(const FunctionTables& tables);

}  // namespace roci::pddl
