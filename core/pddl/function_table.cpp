#include "core/pddl/function_table.hpp"

#include <array>
#include <charconv>

#include "core/pddl/line_scanner.hpp"
#include "core/pddl/printer.hpp"
#include "core/pddl/sexpr.hpp"

namespace roci::pddl {

namespace {

constexpr std::string_view kForm =
    "write (FUNCTION OBJECT …) NUMBER, 'unreachable' or 'unknown' for the number, or >= NUMBER for a lower "
    "bound";

double read_bound(LineScanner& scanner, std::string_view word) {
  const SourceLocation where = scanner.here();
  const std::optional<double> bound =
      as_number(word.size() > 2 ? std::string(word.substr(2)) : scanner.take_word());
  if (!bound) scanner.fail(where, "a number expected after >=", kForm);
  return *bound;
}

// Adds an entry; whether it says the same as one that stands there.
template <typename Map, typename Value>
bool add(Map& map, const std::string& application, const Value& value) {
  const auto [it, first] = map.emplace(application, value);
  return first || it->second == value;
}

void read_entry(LineScanner& scanner, FunctionTables& tables) {
  const Atom function = scanner.expect_ground_atom("a function");
  scanner.at_end();
  const SourceLocation where = scanner.here();
  const std::string word = scanner.take_word();
  const std::string application = print(function);
  bool alone = true;
  if (word.starts_with(">=")) {
    alone = add(tables.lower_bounds, application, read_bound(scanner, word));
  } else if (word == "unknown") {
    tables.unknown.insert(application);
  } else {
    const std::optional<double> value = as_number(word);
    if (!value && word != "unreachable") scanner.fail(where, "a value expected", kForm);
    alone = add(tables.exact, application, value);
  }
  scanner.expect_end(kForm);
  if (!alone || (tables.unknown.contains(application) && tables.exact.contains(application)))
    scanner.fail(function.where, application + " has two values", "keep one");
}

std::string digits(double value) {
  std::array<char, 32> buffer{};
  return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

}  // namespace

void put(FunctionTable& table, const std::string& function, const std::vector<std::string>& arguments,
         std::optional<double> value) {
  std::string application = "(" + function;
  for (const std::string& argument : arguments) application += " " + argument;
  table[application + ")"] = value;
}

FunctionTables parse_function_tables(std::string_view text, std::string_view file) {
  FunctionTables tables;
  for_each_line(text, file, [&](LineScanner& scanner) { read_entry(scanner, tables); });
  return tables;
}

FunctionTable parse_function_table(std::string_view text, std::string_view file) {
  return parse_function_tables(text, file).exact;
}

std::string print(const FunctionTable& table) {
  std::string out;
  for (const auto& [application, value] : table)
    out += application + " " + (value ? digits(*value) : "unreachable") + "\n";
  return out;
}

std::string print(const FunctionTables& tables) {
  std::string out = print(tables.exact);
  for (const auto& [application, bound] : tables.lower_bounds)
    out += application + " >= " + digits(bound) + "\n";
  for (const std::string& application : tables.unknown) out += application + " unknown\n";
  return out;
}

}  // namespace roci::pddl
