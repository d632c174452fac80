#include <charconv>
#include <stdexcept>

#include "core/pddl/overloaded.hpp"
#include "core/pddl/print_parts.hpp"
#include "core/pddl/printer.hpp"

namespace roci::pddl {

std::string print_number(double value) {
  char text[400];  // the longest finite double has 309 digits before the point
  const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed);
  if (error != std::errc()) throw std::logic_error("a double of more than 400 characters");
  return std::string(text, end);
}

std::string print(const Atom& atom) {
  std::string text;
  text.reserve(64);  // of most atoms
  text += '(';
  text += atom.symbol;
  for (const Term& term : atom.arguments) {
    text += ' ';
    text += term.name;
  }
  text += ')';
  return text;
}

std::string print(const Literal& literal) {
  return literal.negated ? "(not " + print(literal.atom) + ")" : print(literal.atom);
}

std::string print(ComparisonOperator op) {
  switch (op) {
    case ComparisonOperator::less:
      return "<";
    case ComparisonOperator::less_equal:
      return "<=";
    case ComparisonOperator::equal:
      return "=";
    case ComparisonOperator::greater_equal:
      return ">=";
    case ComparisonOperator::greater:
      break;
  }
  return ">";
}

namespace {

std::string print(ArithmeticOperator op) {
  switch (op) {
    case ArithmeticOperator::add:
      return "+";
    case ArithmeticOperator::subtract:
      return "-";
    case ArithmeticOperator::multiply:
      return "*";
    case ArithmeticOperator::divide:
      break;
  }
  return "/";
}

template <typename T>
std::string print_list(std::string head, const std::vector<T>& parts) {
  for (const T& part : parts) head += " " + pddl::print(part);
  return "(" + head + ")";
}

std::string print_quantified(std::string_view head, const std::vector<TypedName>& variables,
                             const Condition& body) {
  return "(" + std::string(head) + " (" + print_typed_names(variables) + ") " + pddl::print(body) + ")";
}

}  // namespace

std::string print_typed_names(const std::vector<TypedName>& names) {
  std::string text;
  for (const TypedName& name : names) {
    if (!text.empty()) text += " ";
    text += name.name + " - ";
    if (name.types.size() == 1) {
      text += name.types.front();
      continue;
    }
    text += "(either";
    for (const std::string& type : name.types) text += " " + type;
    text += ")";
  }
  return text;
}

std::string print(const Expression& expression) {
  return std::visit(Overloaded{[](const Number& number) { return print_number(number.value); },
                               [](const Atom& atom) { return print(atom); },
                               [](const DurationVariable&) { return std::string("?duration"); },
                               [](const TotalTime&) { return std::string("(total-time)"); },
                               [](const ContinuousTime&) { return std::string("#t"); },
                               [](const Arithmetic& sum) { return print_list(print(sum.op), sum.operands); }},
                    expression.node);
}

std::string print(const Condition& condition) {
  return std::visit(
      Overloaded{
          [](const And& all) { return print_list("and", all.parts); },
          [](const Or& any) { return print_list("or", any.parts); },
          [](const Not& negation) { return "(not " + print(*negation.body) + ")"; },
          [](const Imply& imply) {
            return "(imply " + print(*imply.premise) + " " + print(*imply.conclusion) + ")";
          },
          [](const Forall& forall) { return print_quantified("forall", forall.variables, *forall.body); },
          [](const Exists& exists) { return print_quantified("exists", exists.variables, *exists.body); },
          [](const Atom& atom) { return print(atom); },
          [](const TermEquality& equal) { return "(= " + equal.left.name + " " + equal.right.name + ")"; },
          [](const Comparison& compare) {
            return "(" + print(compare.op) + " " + print(compare.left) + " " + print(compare.right) + ")";
          }},
      condition.node);
}

}  // namespace roci::pddl
