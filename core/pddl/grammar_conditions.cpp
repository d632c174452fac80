#include "core/pddl/grammar.hpp"

namespace roci::pddl::grammar {

namespace {

void require_parts(const Sexpr& s, std::size_t count, std::string_view form, const Source& source) {
  if (s.items().size() == count + 1) return;
  source.fail(s.where,
              "'" + std::string(s.head()) + "' with " + std::to_string(s.items().size() - 1) +
                  " parts, not " + std::to_string(count),
              "write " + std::string(form));
}

std::vector<Condition> read_parts(const Sexpr& s, const Source& source) {
  std::vector<Condition> parts;
  for (const Sexpr& item : rest(s)) source.attempt([&] { parts.push_back(read_condition(item, source)); });
  return parts;
}

// `=` between two plain names is about objects; with a list, a number or ?duration on a side it is about
// numbers.
bool is_numeric(const Sexpr& s) {
  return s.is_list() || as_number(s.word()) || s.word() == "?duration" || s.word() == "#t";
}

Condition read_comparison(const Sexpr& s, ComparisonOperator op, const Source& source) {
  require_parts(s, 2, "(" + std::string(s.head()) + " a b)", source);
  const Sexpr& left = s.items()[1];
  const Sexpr& right = s.items()[2];
  if (op == ComparisonOperator::equal && !is_numeric(left) && !is_numeric(right)) {
    Atom both = read_atom(s, "an equality", source);
    return {TermEquality{std::move(both.arguments[0]), std::move(both.arguments[1])}, s.where};
  }
  return {Comparison{op, read_expression(left, source), read_expression(right, source)}, s.where};
}

}  // namespace

Condition read_condition(const Sexpr& s, const Source& source) {
  require_list(s, "a condition", source);
  const std::string_view head = s.head();
  if (s.items().empty()) return {And{}, s.where};
  if (head == "and") return {And{read_parts(s, source)}, s.where};
  if (head == "or") return {Or{read_parts(s, source)}, s.where};
  if (head == "not") {
    require_parts(s, 1, "(not CONDITION)", source);
    return {Not{read_condition(s.items()[1], source)}, s.where};
  }
  if (head == "imply") {
    require_parts(s, 2, "(imply PREMISE CONCLUSION)", source);
    return {Imply{read_condition(s.items()[1], source), read_condition(s.items()[2], source)}, s.where};
  }
  if (head == "forall" || head == "exists") {
    require_parts(s, 2, "(" + std::string(head) + " (?x - TYPE …) CONDITION)", source);
    auto variables = read_variables(s.items()[1], source);
    Box<Condition> body = read_condition(s.items()[2], source);
    if (head == "forall") return {Forall{std::move(variables), std::move(body)}, s.where};
    return {Exists{std::move(variables), std::move(body)}, s.where};
  }
  if (const auto op = as_comparison(head)) return read_comparison(s, *op, source);
  return {read_atom(s, "a condition", source), s.where};
}

// ---- Conditions of durative actions

namespace {

struct PartsByTime {
  std::vector<Condition> at_start;
  std::vector<Condition> over_all;
  std::vector<Condition> at_end;
};

Condition conjunction(std::vector<Condition> parts, SourceLocation where) {
  if (parts.size() == 1) return std::move(parts.front());
  return {And{std::move(parts)}, where};
}

void add_timed(const Sexpr& s, PartsByTime& out, const Source& source);

// Distributes the quantifier over the times: forall x (at start p) and (at end q) make two foralls.
void add_forall(const Sexpr& s, PartsByTime& out, const Source& source) {
  require_parts(s, 2, "(forall (?x - TYPE …) CONDITION)", source);
  const auto variables = read_variables(s.items()[1], source);
  PartsByTime inner;
  add_timed(s.items()[2], inner, source);
  const auto wrap = [&](std::vector<Condition> from, std::vector<Condition>& to) {
    if (!from.empty()) to.push_back({Forall{variables, conjunction(std::move(from), s.where)}, s.where});
  };
  wrap(std::move(inner.at_start), out.at_start);
  wrap(std::move(inner.over_all), out.over_all);
  wrap(std::move(inner.at_end), out.at_end);
}

void add_timed(const Sexpr& s, PartsByTime& out, const Source& source) {
  require_list(s, "a condition", source);
  const std::string_view head = s.head();
  if (s.items().empty()) return;
  if (head == "and") {
    for (const Sexpr& item : rest(s)) source.attempt([&] { add_timed(item, out, source); });
  } else if (head == "forall") {
    add_forall(s, out, source);
  } else if (head == "preference") {
    source.refuse(s.where, "preferences are not supported", "state it as a condition or a goal");
  } else if (s.items().size() == 3 && head == "at" && s.items()[1].is_word("start")) {
    out.at_start.push_back(read_condition(s.items()[2], source));
  } else if (s.items().size() == 3 && head == "at" && s.items()[1].is_word("end")) {
    out.at_end.push_back(read_condition(s.items()[2], source));
  } else if (s.items().size() == 3 && head == "over" && s.items()[1].is_word("all")) {
    out.over_all.push_back(read_condition(s.items()[2], source));
  } else {
    source.fail(s.where, "a condition of a durative action without a time",
                "write (at start …), (over all …) or (at end …) around it");
  }
}

}  // namespace

TimedCondition read_timed_condition(const Sexpr& s, const Source& source) {
  PartsByTime parts;
  add_timed(s, parts, source);
  return {conjunction(std::move(parts.at_start), s.where), conjunction(std::move(parts.over_all), s.where),
          conjunction(std::move(parts.at_end), s.where)};
}

}  // namespace roci::pddl::grammar
