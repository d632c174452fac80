#include "core/pddl/grammar.hpp"

namespace roci::pddl::grammar {

std::optional<ComparisonOperator> as_comparison(std::string_view word) {
  if (word == "<") return ComparisonOperator::less;
  if (word == "<=") return ComparisonOperator::less_equal;
  if (word == "=") return ComparisonOperator::equal;
  if (word == ">=") return ComparisonOperator::greater_equal;
  if (word == ">") return ComparisonOperator::greater;
  return {};
}

namespace {

std::optional<ArithmeticOperator> as_arithmetic(std::string_view word) {
  if (word == "+") return ArithmeticOperator::add;
  if (word == "-") return ArithmeticOperator::subtract;
  if (word == "*") return ArithmeticOperator::multiply;
  if (word == "/") return ArithmeticOperator::divide;
  return {};
}

Arithmetic read_arithmetic(const Sexpr& s, ArithmeticOperator op, const Source& source) {
  const std::size_t count = s.items().size() - 1;
  const bool many = op == ArithmeticOperator::add || op == ArithmeticOperator::multiply;
  const bool negation = op == ArithmeticOperator::subtract && count == 1;
  if (count < 2 && !negation) {
    source.fail(s.where, "'" + std::string(s.head()) + "' needs two operands", "write (OP a b)");
  }
  if (count > 2 && !many) {
    source.fail(s.where, "'" + std::string(s.head()) + "' takes two operands", "nest: (OP (OP a b) c)");
  }
  Arithmetic arithmetic;
  arithmetic.op = op;
  for (const Sexpr& item : rest(s)) arithmetic.operands.push_back(read_expression(item, source));
  return arithmetic;
}

}  // namespace

Expression read_expression(const Sexpr& s, const Source& source) {
  if (!s.is_list()) {
    if (const auto number = as_number(s.word())) return {Number{*number}, s.where};
    if (s.word() == "?duration") return {DurationVariable{}, s.where};
    if (s.word() == "total-time") return {TotalTime{}, s.where};
    if (s.word() == "#t") return {ContinuousTime{}, s.where};
    return {read_function(s, source), s.where};
  }
  if (as_arithmetic(s.head())) {
    return {read_arithmetic(s, *as_arithmetic(s.head()), source), s.where};
  }
  if (s.head() == "total-time" && s.items().size() == 1) return {TotalTime{}, s.where};
  if (s.head() == "is-violated") {
    source.refuse(s.where, "preferences are not supported", "remove 'is-violated' from the metric");
  }
  return {read_function(s, source), s.where};
}

}  // namespace roci::pddl::grammar
