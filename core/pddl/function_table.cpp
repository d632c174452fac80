#include "core/pddl/function_table.hpp"

#include <array>
#include <charconv>

#include "core/pddl/line_scanner.hpp"
#include "core/pddl/printer.hpp"
#include "core/pddl/sexpr.hpp"

namespace roci::pddl {

namespace {

void read_entry(LineScanner& scanner, FunctionTable& table) {
  static constexpr std::string_view kForm =
      "write (FUNCTION OBJECT …) NUMBER, or 'unreachable' for the number";
  const Atom function = scanner.expect_ground_atom("a function");
  scanner.at_end();
  const SourceLocation where = scanner.here();
  const std::string word = scanner.take_word();
  const std::optional<double> value = as_number(word);
  if (!value && word != "unreachable") scanner.fail(where, "a value expected", kForm);
  scanner.expect_end(kForm);
  const auto [it, first] = table.emplace(print(function), value);
  if (!first && it->second != value) {
    scanner.fail(function.where, print(function) + " has two values", "keep one");
  }
}

}  // namespace

void put(FunctionTable& table, const std::string& function, const std::vector<std::string>& arguments,
         std::optional<double> value) {
  std::string application = "(" + function;
  for (const std::string& argument : arguments) application += " " + argument;
  table[application + ")"] = value;
}

FunctionTable parse_function_table(std::string_view text, std::string_view file) {
  FunctionTable table;
  for_each_line(text, file, [&](LineScanner& scanner) { read_entry(scanner, table); });
  return table;
}

std::string print(const FunctionTable& table) {
  std::string out;
  for (const auto& [application, value] : table) {
    std::array<char, 32> digits{};
    char* end = digits.data();
    if (value) end = std::to_chars(digits.data(), digits.data() + digits.size(), *value).ptr;
    out += application + " " + (value ? std::string(digits.data(), end) : "unreachable") + "\n";
  }
  return out;
}

}  // namespace roci::pddl
