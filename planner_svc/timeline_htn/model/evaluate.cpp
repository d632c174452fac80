#include "planner_svc/timeline_htn/model/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include "planner_svc/timeline_htn/model/bounds.hpp"

namespace roci::planner::timeline_htn::model {

namespace {

std::vector<Index> row_of(const std::vector<Term>& terms, std::span<const Index> objects) {
  std::vector<Index> row;
  row.reserve(terms.size());
  for (const Term& term : terms) row.push_back(object_of(term, objects));
  return row;
}

bool compare(Comparison comparison, double left, double right) {
  switch (comparison) {
    case Comparison::lt:
      return left < right;
    case Comparison::le:
      return left <= right;
    case Comparison::eq:
      return left == right;
    case Comparison::ne:
      return left != right;
    case Comparison::ge:
      return left >= right;
    case Comparison::gt:
      return left > right;
  }
  return false;
}

double apply(Operator op, double left, double right) {
  switch (op) {
    case Operator::add:
      return left + right;
    case Operator::subtract:
      return left - right;
    case Operator::multiply:
      return left * right;
    default:
      return left / right;
  }
}

std::optional<temporal::Duration> duration(const Model& model, const Expression& expression,
                                           std::span<const Index> objects, temporal::Duration otherwise) {
  if (expression.empty()) return otherwise;
  const std::optional<double> number = evaluate(model, expression, objects);
  return number && *number >= 0 ? duration_of(*number) : std::nullopt;
}

}  // namespace

std::optional<double> evaluate(const Model& model, const Expression& expression,
                               std::span<const Index> objects) {
  std::vector<double> stack;
  for (const ExpressionNode& node : expression) {
    if (node.op == Operator::constant) {
      stack.push_back(node.constant);
    } else if (node.op == Operator::table) {
      const auto& rows = model.numbers[node.table].rows;
      const auto found = rows.find(row_of(node.terms, objects));
      if (found == rows.end()) return std::nullopt;
      stack.push_back(found->second);
    } else {
      if (stack.size() < 2) return std::nullopt;
      const double right = stack.back();
      stack.pop_back();
      stack.back() = apply(node.op, stack.back(), right);
    }
  }
  if (stack.size() != 1 || !std::isfinite(stack.back())) return std::nullopt;
  return stack.back();
}

std::optional<temporal::Duration> duration_of(double seconds) {
  if (!(std::abs(seconds) <= temporal::to_seconds(kLongestDuration))) return std::nullopt;
  return temporal::seconds(seconds);
}

bool has_row(const Relation& relation, const std::vector<Index>& row) {
  return std::ranges::binary_search(relation.rows, row);
}

bool holds(const Model& model, const Test& test, std::span<const Index> objects) {
  switch (test.kind) {
    case Test::Kind::relation:
      return has_row(model.relations[test.relation], row_of(test.terms, objects)) != test.negated;
    case Test::Kind::terms: {
      const bool equal = object_of(test.terms[0], objects) == object_of(test.terms[1], objects);
      return equal == (test.comparison == Comparison::eq);
    }
    case Test::Kind::numbers: {
      const auto left = evaluate(model, test.left, objects), right = evaluate(model, test.right, objects);
      return left && right && compare(test.comparison, *left, *right);
    }
  }
  return false;
}

std::optional<Bounds> bounds(const Model& model, const State& state, std::span<const Index> objects) {
  const auto shortest = duration(model, state.shortest, objects, temporal::Duration{0});
  const auto longest = duration(model, state.longest, objects, temporal::no_bound);
  if (!shortest || !longest || *longest < *shortest) return std::nullopt;
  return Bounds{*shortest, *longest};
}

void add_asked(const Model& model, const Expression& expression, std::span<const Index> objects,
               std::set<AskedNumber>& out) {
  for (const ExpressionNode& node : expression)
    if (node.op == Operator::table && model.numbers[node.table].asked)
      out.insert({node.table, row_of(node.terms, objects)});
}

void add_asked(const Model& model, const Test& test, std::span<const Index> objects,
               std::set<AskedNumber>& out) {
  add_asked(model, test.left, objects, out);
  add_asked(model, test.right, objects, out);
}

void add_asked(const Model& model, const State& state, std::span<const Index> objects,
               std::set<AskedNumber>& out) {
  add_asked(model, state.shortest, objects, out);
  add_asked(model, state.longest, objects, out);
  for (const Test& test : state.where) add_asked(model, test, objects, out);
}

std::string text_of(const Model& model, const Argument& argument, std::span<const Index> objects) {
  if (!argument.term) return argument.text;
  const std::string& object = model.objects[object_of(*argument.term, objects)].name;
  return argument.property.empty() ? object : object + "." + argument.property;
}

}  // namespace roci::planner::timeline_htn::model
